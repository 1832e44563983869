#include "render/image/polarization.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "meshprep/base/error.h"

namespace malus::render {

namespace {

using Stokes3 = std::array<double, 3>;
constexpr const char* kColours[] = {"R", "G", "B"};
constexpr double kPi = std::numbers::pi;

std::size_t stokesChannel(const image::Image& image, int component, int colour) {
  const std::string name = fmt::format("S{}.{}", component, kColours[colour]);
  const int index = image.channel(name);
  if (index < 0)
    throw Error("", fmt::format("the image has no channel {}", name),
                "an image rendered with Stokes vectors (--method stokes)");
  return static_cast<std::size_t>(index);
}

std::vector<Stokes3> weightedStokes(const image::Image& image, const std::array<double, 3>& weights) {
  const StokesChannels stokes(image);
  const std::size_t channels = image.channels.size();
  std::vector<Stokes3> result(channels == 0 ? 0 : image.pixels.size() / channels);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = stokes.weighted(i, weights);
  return result;
}

// Calls function(i) for each pixel, in parallel.
template <class Function>
void forEachPixel(std::size_t count, const Function& function) {
  constexpr std::size_t kGrain = 4096;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
  });
}

// One channel per colour, computed from its S0, S1, S2.
template <class F>
image::Image perColour(const image::Image& image, const char* name, F value) {
  image::Image result;
  result.width = image.width;
  result.height = image.height;
  result.attributes = image.attributes;
  for (int colour = 0; colour < 3; ++colour) {
    result.channels.push_back(fmt::format("{}.{}", name, kColours[colour]));
    const std::vector<Stokes3> stokes = colourStokes(image, colour);
    result.pixels.resize(3 * stokes.size());
    forEachPixel(stokes.size(),
                 [&](std::size_t i) { result.pixels[3 * i + static_cast<std::size_t>(colour)] = value(stokes[i]); });
  }
  return result;
}

template <class F>
std::vector<std::uint8_t> coloured(const image::Image& image, F colour) {
  const std::vector<Stokes3> stokes = luminanceStokes(image);
  std::vector<std::uint8_t> bytes(3 * stokes.size());
  forEachPixel(stokes.size(), [&](std::size_t i) {
    const std::array<std::uint8_t, 3> c = colour(stokes[i]);
    std::copy(c.begin(), c.end(), bytes.begin() + static_cast<std::ptrdiff_t>(3 * i));
  });
  return bytes;
}

// The sRGB curve (IEC 61966-2-1), to a byte.
std::uint8_t srgbByte(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055)));
}

// matplotlib's viridis at 18 equal steps from 0 to 1; straight lines between them are within 2 of 255.
constexpr std::array<std::array<std::uint8_t, 3>, 18> kViridis = {{
    {68, 1, 84},
    {72, 23, 105},
    {71, 42, 122},
    {67, 61, 132},
    {61, 78, 138},
    {53, 94, 141},
    {46, 109, 142},
    {41, 123, 142},
    {35, 137, 142},
    {31, 151, 139},
    {33, 165, 133},
    {46, 179, 124},
    {70, 192, 111},
    {101, 203, 94},
    {137, 213, 72},
    {176, 221, 47},
    {216, 226, 25},
    {253, 231, 37},
}};

void write(const std::filesystem::path& path, const image::Image& image, image::ExrCompression compression,
           image::Image (*channels)(const image::Image&), std::vector<std::uint8_t> (*colours)(const image::Image&)) {
  const std::string extension = path.extension().string();
  if (extension == ".exr")
    image::writeExr(path, channels(image), compression);
  else if (extension == ".png")
    image::writePng(path, image.width, image.height, 3, colours(image));
  else
    throw Error(path.string(), "unknown image format", ".exr or .png", extension.empty() ? "no extension" : extension);
}

}  // namespace

double degreeOfLinearPolarization(double s0, double s1, double s2) {
  const double dolp = std::hypot(s1, s2) / s0;
  return s0 > 0 && std::isfinite(dolp) ? std::min(dolp, 1.0) : 0;
}

double angleOfLinearPolarization(double s1, double s2) {
  const double half = std::atan2(s2, s1) / 2, angle = half < 0 ? half + kPi : half;
  return angle >= 0 && angle < kPi ? angle : 0;  // NaN, or a negative angle of the size of rounding errors
}

StokesChannels::StokesChannels(const image::Image& image) : image_(image) {
  for (int component = 0; component < 3; ++component)
    for (int colour = 0; colour < 3; ++colour)
      index_[static_cast<std::size_t>(component)][static_cast<std::size_t>(colour)] =
          stokesChannel(image, component, colour);
}

std::array<double, 3> StokesChannels::weighted(std::size_t pixel, const std::array<double, 3>& weights) const {
  const float* const values = image_.pixels.data() + pixel * image_.channels.size();
  std::array<double, 3> stokes{};
  for (std::size_t component = 0; component < stokes.size(); ++component)
    for (std::size_t colour = 0; colour < weights.size(); ++colour)
      if (weights[colour] != 0)
        stokes[component] += weights[colour] * static_cast<double>(values[index_[component][colour]]);
  return stokes;
}

std::vector<Stokes3> luminanceStokes(const image::Image& image) { return weightedStokes(image, kLuminanceWeights); }
std::vector<Stokes3> colourStokes(const image::Image& image, int colour) {
  return weightedStokes(image, {colour == 0 ? 1.0 : 0.0, colour == 1 ? 1.0 : 0.0, colour == 2 ? 1.0 : 0.0});
}

image::Image dolpChannels(const image::Image& image) {
  return perColour(image, "DoLP",
                   [](const Stokes3& s) { return static_cast<float>(degreeOfLinearPolarization(s[0], s[1], s[2])); });
}
image::Image aolpChannels(const image::Image& image) {
  return perColour(image, "AoLP", [](const Stokes3& s) {
    const double angle = angleOfLinearPolarization(s[1], s[2]);
    const auto rounded = static_cast<float>(angle);
    return static_cast<double>(rounded) < kPi ? rounded : 0.0f;  // the nearest float to pi is above it
  });
}

std::array<std::uint8_t, 3> dolpColour(double dolp) {
  const double x = std::clamp(dolp, 0.0, 1.0) * (kViridis.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), kViridis.size() - 2);
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<std::uint8_t>(std::lround(std::lerp(
        static_cast<double>(kViridis[i][c]), static_cast<double>(kViridis[i + 1][c]), x - static_cast<double>(i))));
  return colour;
}
std::vector<std::uint8_t> dolpColours(const image::Image& image) {
  return coloured(image, [](const Stokes3& s) { return dolpColour(degreeOfLinearPolarization(s[0], s[1], s[2])); });
}

std::array<std::uint8_t, 3> aolpColour(double aolp, double dolp) {
  // At lightness 0.75 every hue of chroma 0.125 is within sRGB. Hue 29 degrees is that of sRGB's red.
  constexpr double kLightness = 0.75, kChroma = 0.125, kFirstHue = 29 * kPi / 180;
  const double fade = std::clamp(dolp / kAolpFadeDolp, 0.0, 1.0), hue = kFirstHue + 2 * aolp;
  const double lightness = fade * kLightness, a = fade * kChroma * std::cos(hue), b = fade * kChroma * std::sin(hue);
  // Oklab to linear sRGB, with Ottosson's numbers.
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {srgbByte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgbByte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgbByte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}
std::vector<std::uint8_t> aolpColours(const image::Image& image) {
  return coloured(image, [](const Stokes3& s) {
    return aolpColour(angleOfLinearPolarization(s[1], s[2]), degreeOfLinearPolarization(s[0], s[1], s[2]));
  });
}

void writeDolp(const std::filesystem::path& path, const image::Image& image, image::ExrCompression compression) {
  write(path, image, compression, dolpChannels, dolpColours);
}
void writeAolp(const std::filesystem::path& path, const image::Image& image, image::ExrCompression compression) {
  write(path, image, compression, aolpChannels, aolpColours);
}

}  // namespace malus::render
