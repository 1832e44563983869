#include "render/compare/picture_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::render {

namespace {

// CIELAB of a displayed colour: linear sRGB primaries, D65 white at 1, brighter cut off as displays do. Source:
// IEC 61966-2-1 (matrix), CIE 15:2004 (L*, a*, b*).
struct Lab {
  double l, a, b;
};
Lab labOf(const Picture& picture, std::size_t pixel, double gain) {
  double c[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = picture.pixels[pixel * picture.channels + i] * gain;
    c[i] = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 1.0;
  }
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505);
  const double y = f(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
  const double z = f((0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.0890);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// A just noticeable difference in CIELAB: Mahy, Van Eycken and Oosterlinck, Evaluation of uniform color spaces
// developed after the adoption of CIELAB and CIELUV, Color Research and Application 19(2), 1994.
constexpr double kJustNoticeable = 2.3;

}  // namespace

PictureError pictureError(const Picture& picture, const Picture& reference, double exposureEv) {
  if (picture.width != reference.width || picture.height != reference.height)
    throw Error("", "pictures differ in size", fmt::format("{} x {}", reference.width, reference.height),
                fmt::format("{} x {}", picture.width, picture.height));
  const std::size_t count = std::size_t{picture.width} * picture.height;
  double total = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) total += reference.pixels[i * reference.channels + c];
  const double floor = 1e-3 * total / (3 * static_cast<double>(count));

  PictureError error;
  double sum = 0, squares = 0, referenceSquares = 0, energy = 0;
  std::size_t off = 0, seen = 0;
  const double gain = std::exp2(exposureEv);
  for (std::size_t i = 0; i < count; ++i) {
    bool isOff = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double truth = reference.pixels[i * reference.channels + c],
                   value = picture.pixels[i * picture.channels + c];
      const double d = std::isfinite(value) ? std::abs(value - truth) : std::numeric_limits<double>::infinity();
      sum += d;
      squares += d * d;
      referenceSquares += truth * truth;
      energy += value;
      error.maxAbs = std::max(error.maxAbs, d);
      isOff = isOff || d > 0.01 * std::max(std::abs(truth), floor);
    }
    if (isOff) ++off;
    const Lab p = labOf(picture, i, gain), q = labOf(reference, i, gain);
    if (std::hypot(p.l - q.l, p.a - q.a, p.b - q.b) > kJustNoticeable) ++seen;
  }
  error.meanAbs = sum / (3 * static_cast<double>(count));
  error.relRms = referenceSquares > 0 ? std::sqrt(squares / referenceSquares) : std::sqrt(squares);
  error.shareOver1Percent = static_cast<double>(off) / static_cast<double>(count);
  error.energyRatio = total > 0 ? energy / total : (energy == 0 ? 1 : std::numeric_limits<double>::infinity());
  error.perceptual = static_cast<double>(seen) / static_cast<double>(count);
  return error;
}

}  // namespace malus::render
