#include "render/scene/render_parameters.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "shaders/methods/methods.h"

namespace malus::render {

namespace {

// Cosine and sine of an angle in degrees, exact at multiples of 90, so that a filter along an axis has no
// trace of another component.
struct Turn {
  double cos, sin;
};
Turn turnOf(double degrees) {
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

// Light from a glass mirror at Brewster's angle, linearly polarized, that meets a metal mirror whose plane of
// incidence is at 45 degrees to the glass's: what goes to the eye is linear in part and circular in part.
template <class M>
CarriedLight probe() {
  using f32::real3;
  const real3 toMetal(0, 0, -1), metalNormal(0.5f, 0.5f, std::sqrt(0.5f));
  const real3 toGlass = f32::mirrorDirection(toMetal, metalNormal, metalNormal.z);
  const real3 side = glm::normalize(real3(0, 0, 1) + glm::cross(toGlass, real3(0, 0, 1)));
  const real3 glassNormal = glm::normalize(side * 1.5f - toGlass);
  const auto glass = M::dielectricTerms(-glm::dot(toGlass, glassNormal), 1.0f, 1.5f);
  const auto metal = M::conductorTerms(metalNormal.z, 1.0f, real3(0.2f), real3(3.0f));
  const real3 glassS = M::surfaceS(toGlass, glassNormal), metalS = M::surfaceS(toMetal, metalNormal);
  const auto fromGlass = M::payloadFromSurface(M::lightReflect(glass, M::lightUnpolarized(real3(1))), toGlass, glassS);
  const auto fromMetal =
      M::payloadFromSurface(M::lightReflect(metal, M::lightAtSurface(fromGlass, toGlass, metalS)), toMetal, metalS);
  const f32::Stokes seen = M::payloadStokes(fromMetal, toMetal);
  const auto some = [&](const real3& v) { return std::abs(v.x) > 1e-2f * seen.s0.x; };
  return {some(seen.s1) || some(seen.s2), some(seen.s3)};
}

}  // namespace

Analyser linearPolarizer(double degrees) {
  const Turn twice = turnOf(2 * std::fmod(degrees, 180.0));
  return {0.5, 0.5 * twice.cos, 0.5 * twice.sin, 0};
}

Analyser circularAnalyser(Handedness handedness) { return {0.5, 0, 0, handedness == Handedness::right ? 0.5 : -0.5}; }

Analyser behindWavePlate(const Analyser& analyser, const WavePlate& plate) {
  const Turn axis = turnOf(2 * std::fmod(plate.axisDegrees, 180.0)), delay = turnOf(plate.retardanceDegrees);
  const auto [w, q, u, v] = analyser;
  // ImportanceVector times R(-a): its components along and across the plate's axes; times G: the delay; times R(a):
  // back.
  const double along = q * axis.cos + u * axis.sin, across = u * axis.cos - q * axis.sin;
  const double delayed = across * delay.cos - v * delay.sin, circular = across * delay.sin + v * delay.cos;
  return {w, along * axis.cos - delayed * axis.sin, along * axis.sin + delayed * axis.cos, circular};
}

CarriedLight carriedBy(std::string_view method) {
#define MALUS_PROBE(M) \
  if (method == f32::M::kName) return probe<f32::M>();
  MALUS_FOR_EACH_METHOD(MALUS_PROBE)
#undef MALUS_PROBE
  if (method == "schlick-iterative" || method == "fresnel-iterative") return {false, false};
  return {};
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
