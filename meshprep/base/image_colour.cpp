#include "meshprep/base/image_colour.h"

#include <strings.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::image {

double decodeSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  // rows

constexpr std::array<double, 8> kRec709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
constexpr double kSameChromaticity = 1e-3;

Vector multiply(const Matrix& m, const Vector& v) {
  Vector r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}
Matrix multiply(const Matrix& a, const Matrix& b) {
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return r;
}

// Nothing: singular.
std::optional<Matrix> inverse(const Matrix& m) {
  Matrix r{};
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  if (!(std::abs(determinant) > 1e-9)) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = cofactor(j, i) / determinant;
  return r;
}

// XYZ of a chromaticity with Y = 1.
Vector xyz(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

// From RGB with chromaticities c to XYZ (SMPTE RP 177): the columns are the primaries, scaled to add up to white.
std::optional<Matrix> toXyz(const std::array<double, 8>& c) {
  for (std::size_t i = 1; i < 8; i += 2)
    if (!(std::abs(c[i]) > 1e-6)) return std::nullopt;
  Matrix primaries{};
  for (std::size_t j = 0; j < 3; ++j) {
    const Vector p = xyz(c[2 * j], c[2 * j + 1]);
    for (std::size_t i = 0; i < 3; ++i) primaries[i][j] = p[i];
  }
  const std::optional<Matrix> inverted = inverse(primaries);
  if (!inverted) return std::nullopt;
  const Vector scale = multiply(*inverted, xyz(c[6], c[7]));
  for (Vector& row : primaries)
    for (std::size_t j = 0; j < 3; ++j) row[j] *= scale[j];
  return primaries;
}

// Chromatic adaptation of XYZ from one white to another (Bradford; ICC.1:2010, annex E).
Matrix adaptation(const Vector& from, const Vector& to) {
  constexpr Matrix kBradford = {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Vector a = multiply(kBradford, from), b = multiply(kBradford, to);
  Matrix scaled = kBradford;
  for (std::size_t i = 0; i < 3; ++i)
    for (double& value : scaled[i]) value *= b[i] / a[i];
  return multiply(*inverse(kBradford), scaled);
}

std::optional<Matrix> toRec709(const std::array<double, 8>& c) {
  const std::optional<Matrix> source = toXyz(c), target = inverse(*toXyz(kRec709));
  if (!source) return std::nullopt;
  return multiply(*target, multiply(adaptation(xyz(c[6], c[7]), xyz(kRec709[6], kRec709[7])), *source));
}

bool isRec709(const std::array<double, 8>& c) {
  return std::equal(c.begin(), c.end(), kRec709.begin(),
                    [](double a, double b) { return std::abs(a - b) <= kSameChromaticity; });
}

std::optional<std::size_t> findChannel(const Image& image, const char* name) {
  for (std::size_t i = 0; i < image.channels.size(); ++i)
    if (::strcasecmp(image.channels[i].c_str(), name) == 0) return i;
  return std::nullopt;
}

std::optional<std::array<std::size_t, 3>> findColours(const Image& image) {
  const auto r = findChannel(image, "R"), g = findChannel(image, "G"), b = findChannel(image, "B");
  if (r && g && b) return std::array{*r, *g, *b};
  // With RY or BY, Y is the luminance of colours. One channel alone, but for alpha, is grey whatever its name.
  if (findChannel(image, "RY") || findChannel(image, "BY")) return std::nullopt;
  auto grey = findChannel(image, "Y");
  const std::size_t count = image.channels.size();
  if (!grey && (count == 1 || (count == 2 && findChannel(image, "A") == std::size_t{1}))) grey = 0;
  if (!grey) return std::nullopt;
  return std::array{*grey, *grey, *grey};
}

double decode(const Encoding& encoding, double v) {
  switch (encoding.transfer) {
    case Encoding::Transfer::sRgb:  // IEC 61966-2-1
      return decodeSrgb(v);
    case Encoding::Transfer::power:
      return std::pow(std::max(v, 0.0), encoding.exponent);
    default:
      return v;
  }
}

}  // namespace

LinearColours::LinearColours(const Image& image, std::string_view where, bool usesAlpha) : image_(image) {
  const auto found = findColours(image);
  if (!found)
    throw Error(where, "image has no colour", "channels R, G and B, or Y",
                fmt::format("{}", fmt::join(image.channels, ", ")));
  channels_ = *found;
  const auto& chromaticities = image.encoding.chromaticities;
  if (chromaticities && !isRec709(*chromaticities) && !isGrey()) {
    const std::optional<Matrix> matrix = toRec709(*chromaticities);
    if (!matrix)
      throw Error(where, "the chromaticities of the image do not span a plane", "three primaries and a white",
                  fmt::format("{:g}", fmt::join(*chromaticities, " ")));
    toRec709_ = *matrix;
    isConverted_ = true;
  }
  findNotes(where, usesAlpha);
}

std::array<double, 3> LinearColours::stored(std::size_t pixel) const {
  const float* p = image_.pixels.data() + pixel * image_.channels.size();
  return {p[channels_[0]], p[channels_[1]], p[channels_[2]]};
}

std::array<double, 3> LinearColours::unclipped(std::size_t pixel) const {
  Vector v = stored(pixel);
  for (double& value : v) value = decode(image_.encoding, value);
  return isConverted_ ? multiply(toRec709_, v) : v;
}

std::array<double, 3> LinearColours::at(std::size_t pixel) const {
  Vector v = unclipped(pixel);
  if (isConverted_)
    for (double& value : v) value = value < 0 ? 0 : value;  // a NaN stays a NaN
  return v;
}

void LinearColours::findNotes(std::string_view where, bool usesAlpha) {
  for (const std::string& note : image_.encoding.notes) notes_.push_back(fmt::format("{}: {}", where, note));
  if (const std::string& name = image_.channels[channels_[0]]; isGrey() && ::strcasecmp(name.c_str(), "Y") != 0)
    notes_.push_back(fmt::format("{}: the only channel, '{}', is read as grey", where, name));
  const std::size_t pixels = image_.pixels.size() / image_.channels.size();
  if (const auto alpha = findChannel(image_, "A"); alpha && !usesAlpha) {
    std::size_t transparent = 0;
    for (std::size_t i = 0; i < pixels; ++i)
      transparent += image_.pixels[i * image_.channels.size() + *alpha] < 1 ? 1 : 0;
    if (transparent > 0)
      notes_.push_back(
          fmt::format("{}: the alpha channel is left out ({} of {} pixels are not opaque); colours are "
                      "those of the file, not multiplied by it",
                      where, transparent, pixels));
  }
  if (!isConverted_) return;
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const Vector v = unclipped(i);
    clipped += v[0] < 0 || v[1] < 0 || v[2] < 0 ? 1 : 0;
  }
  notes_.push_back(fmt::format(
      "{}: colours are converted from the chromaticities of the file to Rec. 709{}", where,
      clipped > 0 ? fmt::format("; {} of {} pixels are outside it and are clipped at 0", clipped, pixels) : ""));
}

std::vector<std::string> makeLinear(Image& image, std::string_view where, bool usesAlpha) {
  const auto channels = findColours(image);
  if (!channels) return {};
  const LinearColours colours(image, where, usesAlpha);
  const std::size_t count = image.channels.size();
  for (std::size_t i = 0; i < image.pixels.size() / count; ++i) {
    const Vector v = colours.at(i);
    for (std::size_t c = 0; c < 3; ++c) image.pixels[i * count + (*channels)[c]] = static_cast<float>(v[c]);
  }
  image.encoding = {};
  return colours.notes();
}

}  // namespace malus::image
