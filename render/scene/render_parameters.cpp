#include "render/scene/render_parameters.h"

#include <cmath>
#include <numbers>

namespace malus::render {

namespace {

// Cosine and sine of an angle in degrees, exact at multiples of 90, so that other components of a filter
// along an axis are exactly 0.
struct CosSin {
  double cos, sin;
};
CosSin exactCosSin(double degrees) {
  const double whole = std::fmod(degrees, 360.0), quarters = std::nearbyint(whole / 90);
  const double rest = (whole - quarters * 90) * std::numbers::pi / 180, c = std::cos(rest), s = std::sin(rest);
  switch ((static_cast<int>(quarters) + 4) % 4) {
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    case 3:
      return {s, -c};
    default:
      return {c, s};
  }
}

}  // namespace

Analyser linearPolarizer(double degrees) {
  const CosSin twice = exactCosSin(2 * std::fmod(degrees, 180.0));
  return {0.5, 0.5 * twice.cos, 0.5 * twice.sin, 0};
}

Analyser circularAnalyser(Handedness handedness) { return {0.5, 0, 0, handedness == Handedness::right ? 0.5 : -0.5}; }

Analyser behindWavePlate(const Analyser& analyser, const WavePlate& plate) {
  const CosSin axis = exactCosSin(2 * std::fmod(plate.axisDegrees, 180.0)),
               delay = exactCosSin(plate.retardanceDegrees);
  const auto [w, q, u, v] = analyser;
  // Multiply the row by R(-a), which gives its components along and across the plate's axes, by G, which delays them,
  // and by R(a).
  const double along = q * axis.cos + u * axis.sin, across = u * axis.cos - q * axis.sin;
  const double delayed = across * delay.cos - v * delay.sin, circular = across * delay.sin + v * delay.cos;
  return {w, along * axis.cos - delayed * axis.sin, along * axis.sin + delayed * axis.cos, circular};
}

RenderParameters defaultParameters(const pack::Scene& scene) {
  RenderParameters parameters;
  parameters.width = scene.width;
  parameters.height = scene.height;
  parameters.region = {0, 0, scene.width, scene.height};
  parameters.depth = scene.depth;
  return parameters;
}

}  // namespace malus::render
