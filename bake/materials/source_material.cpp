#include "bake/materials/source_material.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "bake/pack/format.h"

namespace malus::bake {

namespace {

constexpr double kLeastReflectance = 0.001, kMostReflectance = 0.999;
constexpr double kLeastAlpha = 0.01;  // smoother is a mirror
constexpr double kMattAlpha = 0.3;    // rougher is matt
constexpr double kLeastColour = 1e-6;
constexpr double kMostRadiance = 1e9;

// Per metre.
glm::dvec3 volumeAbsorption(const prep::SourceMaterial& source) {
  glm::dvec3 absorption(0.0);
  for (int c = 0; c < 3; ++c) {
    const double colour = std::clamp(source.attenuationColour[c], kLeastColour, 1.0);
    absorption[c] = std::clamp(-std::log(colour) / source.attenuationDistance, 0.0, pack::kMaxAbsorption);
  }
  return absorption;
}

void setMetal(pack::Material& metal, const glm::dvec3& reflectance) {
  for (int c = 0; c < 3; ++c) {
    const double r = std::clamp(reflectance[c], kLeastReflectance, kMostReflectance);
    const double n = (1 - r) / (1 + r);
    metal.eta[c] = n;
    metal.k[c] = std::sqrt((r * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - r));
  }
}

}  // namespace

pack::Material convertMaterial(const prep::SourceMaterial& source, std::vector<std::string>& notes) {
  using Kind = pack::MaterialKind;
  pack::Material result;
  result.name = source.name;
  double alpha = source.roughness * source.roughness;
  if (alpha < kLeastAlpha) alpha = 0;
  const glm::dvec3 colour = glm::clamp(source.baseColour, 0.0, 1.0);
  const glm::dvec3 ior(std::clamp(source.ior, 1.0, pack::kMaxEta));

  // The metallic share of a material is opaque.
  const double transmission = source.transmission * (1 - source.metallic);
  if (transmission > 0 && transmission <= prep::kTransmissive)
    prep::addNote(notes, fmt::format("the transmission of material '{}', at most half of the light", source.name));

  if (source.emissive != glm::dvec3(0.0)) {
    result.kind = Kind::emitter;
    result.radiance = glm::clamp(source.emissive, 0.0, kMostRadiance);
    result.twoSided = source.isDoubleSided;
  } else if (transmission > prep::kTransmissive) {
    result.kind = source.isThinWalled ? Kind::thinGlass : Kind::glass;
    result.eta = ior;
    if (source.isThinWalled) result.transmittanceParallel = colour;  // of thin glass: internal transmittance
    if (source.hasVolume) result.absorption = volumeAbsorption(source);
    if (alpha > 0) prep::addNote(notes, fmt::format("the roughness of glass '{}'", source.name));
    if (transmission < 1) prep::addNote(notes, fmt::format("the opaque part of glass '{}'", source.name));
  } else if (source.metallic >= 0.5) {
    result.kind = Kind::metal;
    setMetal(result, colour);
    result.roughness = std::min(alpha, 1.0);
  } else if (alpha >= kMattAlpha) {
    result.kind = Kind::lambert;
    result.albedo = colour;
  } else {
    result.kind = Kind::paint;
    result.eta = ior;
    result.albedo = colour;
    result.roughness = alpha;
  }
  return result;
}

pack::Material defaultMaterial() {
  pack::Material result;
  result.name = "default";
  result.kind = pack::MaterialKind::lambert;
  result.albedo = glm::dvec3(0.8);
  return result;
}

}  // namespace malus::bake
