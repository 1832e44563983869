#include "render/image/polarization.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <glm/vec3.hpp>

#include "meshprep/base/error.h"
#include "shaders/optics/language_begin.h"

namespace malus::render {

namespace {

namespace display {
using real = double;
using real3 = glm::dvec3;
using std::cos;
using std::exp;
using std::pow;
using std::sin;
#include "shaders/display/aolp_colour.h"
#include "shaders/display/tone_curve.h"
}  // namespace display

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

// The sRGB curve, to a byte.
std::uint8_t srgbByte(double linear) {
  return static_cast<std::uint8_t>(std::lround(255 * display::srgbCurve(std::clamp(linear, 0.0, 1.0))));
}

constexpr std::array<std::array<std::uint8_t, 3>, 18> kViridis = {{
#define MALUS_COLOUR(r, g, b) {r, g, b},
#define MALUS_LAST_COLOUR(r, g, b) \
  { r, g, b }
#include "shaders/display/viridis.def"
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
  const glm::dvec3 c = display::aolpLinearColour(aolp, std::clamp(dolp / kAolpFadeDolp, 0.0, 1.0));
  return {srgbByte(c.x), srgbByte(c.y), srgbByte(c.z)};
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

#include "shaders/optics/language_end.h"
