#include "bake/materials/source_material.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "bake/pack/format.h"

namespace malus::bake {

namespace {

constexpr double kLeastReflectance = 0.001, kMostReflectance = 0.999;
constexpr double kLeastAlpha = 0.01;  // smoother is a mirror
constexpr double kMattAlpha = 0.3;    // rougher is matt
constexpr double kLeastColour = 1e-6;
constexpr double kMostDielectricReflectance = 0.25;  // of an index of 3, above that of every clear solid
constexpr double kCoatIor = 1.5;                     // of KHR_materials_clearcoat
constexpr double kOpaqueAlpha = 0.5;                 // coverage from which a blended material is opaque
constexpr double kBrightEmission = 100;              // of the colour; beside more the reflection is not missed
constexpr double kLeastEmission = 0.1;               // of the colour; less emission gives way to the reflection
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

// An index at which the reflectance is 1 within 1e-8 at every angle.
void setPerfectMirror(pack::Material& metal, int colour) {
  metal.eta[colour] = pack::kMinEta;
  metal.k[colour] = pack::kMaxEta;
}

// The index with this reflectance at normal incidence, as of Fresnel's equations: (1 + sqrt r) / (1 - sqrt r).
glm::dvec3 dielectricIndex(const prep::SourceMaterial& source) {
  if (source.specularColour == glm::dvec3(1.0) && source.ior > 0)
    return glm::dvec3(std::clamp(source.ior, 1.0, pack::kMaxEta));
  const glm::dvec3 root = glm::sqrt(normalReflectance(source));
  return glm::clamp((1.0 + root) / glm::max(1.0 - root, 1e-3), 1.0, pack::kMaxEta);
}

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

// Converts an opaque material that is not metallic; alpha: its roughness.
void setOpaqueDielectric(const prep::SourceMaterial& source, double alpha, pack::Material& result) {
  using Kind = pack::MaterialKind;
  const glm::dvec3 reflectance = normalReflectance(source);
  result.albedo = glm::clamp(source.baseColour, 0.0, 1.0);
  if (isMetallicReflectance(reflectance) && source.specular > 0) {
    result.kind = Kind::metal;
    setMetal(result, reflectance);
    for (int c = 0; c < 3; ++c)
      if (reflectance[c] > kMostReflectance) setPerfectMirror(result, c);
    result.roughness = std::min(alpha, 1.0);
  } else if (alpha >= kMattAlpha || source.specular == 0 || reflectance == glm::dvec3(0.0)) {
    result.kind = Kind::lambert;
  } else {
    result.kind = Kind::paint;
    result.eta = dielectricIndex(source);
    result.roughness = alpha;
  }
}

using Note = std::function<void(std::string_view what)>;

// Adds the clear coat. Where the base has the coat's index, or is a bare diffuse layer, only one interface reflects:
// that of the coat on its share, and that of the base on the rest.
void addClearCoat(const prep::SourceMaterial& source, pack::Material& result, const Note& note) {
  using Kind = pack::MaterialKind;
  if (source.clearcoat == 0) return;
  const double share = source.clearcoat, alpha = facetAlpha(source.clearcoatRoughness);
  const bool isMatched = pack::isDielectric(result.kind) && result.eta == glm::dvec3(kCoatIor);
  if (result.kind == Kind::lambert || isMatched) {
    const double base = isMatched ? result.specularFactor : 0;
    result.specularFactor = share + (1 - share) * base;
  } else if (pack::canBeCoated(result.kind)) {
    result.clearCoat = {kCoatIor, share};
  } else {
    note("the clear coat on thin glass");
    return;
  }
  if (result.kind == Kind::lambert) {
    result.kind = Kind::paint;
    result.eta = glm::dvec3(kCoatIor);
    result.roughness = alpha;
  } else if (!pack::canBeRough(result.kind)) {
    if (alpha > 0) note("the roughness of the clear coat");
  } else if (alpha != result.roughness) {
    // One roughness is drawn: that of the interface that reflects most.
    const bool isOfCoat = pack::isDielectric(result.kind) && share >= 0.5;
    if (isOfCoat) result.roughness = alpha;
    if (!isMatched || share < 1)
      note(isOfCoat ? "the roughness below the clear coat" : "the roughness of the clear coat");
  }
}

void addFilm(const prep::SourceMaterial& source, pack::Material& result, const Note& note) {
  if (source.film == 0 || source.filmThicknessNm == 0) return;
  if (source.film < 0.5) {
    note("the thin film of less than half");
  } else if (!pack::canBeCoated(result.kind)) {
    note("the thin film on a surface without one");
  } else if (result.clearCoat.factor > 0) {
    note("the thin film below the clear coat");
  } else {
    result.coating = {glm::dvec3(std::clamp(source.filmIor, 1.0, pack::kMaxEta)),
                      std::min(source.filmThicknessNm, pack::kMaxThicknessNm)};
    if (source.film < 1) note("the part without a thin film");
  }
}

// Adds the layers of a material, or a note.
void addLayers(const prep::SourceMaterial& source, pack::Material& result, std::vector<std::string>& notes) {
  const Note note = [&](std::string_view what) {
    prep::addNote(notes, fmt::format("{} of material '{}'", what, source.name));
  };
  const bool isDielectric = source.metallic < 0.5;
  if (isDielectric && pack::hasIndex(result.kind)) result.specularFactor = source.specular;
  addClearCoat(source, result, note);
  addFilm(source, result, note);
}

}  // namespace

glm::dvec3 normalReflectance(const prep::SourceMaterial& source) {
  const double root = (source.ior - 1) / (source.ior + 1);
  return glm::min(glm::dvec3(source.ior == 0 ? 1.0 : root * root) * source.specularColour, glm::dvec3(1.0));
}

bool isMetallicReflectance(const glm::dvec3& reflectance) { return largest(reflectance) > kMostDielectricReflectance; }

double facetAlpha(double roughness) { return roughness * roughness < kLeastAlpha ? 0 : roughness * roughness; }

bool isInvisible(const prep::SourceMaterial& source) {
  if (source.alphaMode == prep::AlphaMode::mask) return source.alpha < source.alphaCutoff;
  return source.alphaMode == prep::AlphaMode::blend && source.alpha == 0;
}

pack::Material convertMaterial(const prep::SourceMaterial& source, std::vector<std::string>& notes) {
  using Kind = pack::MaterialKind;
  pack::Material result;
  result.name = source.name;
  const double alpha = facetAlpha(source.roughness);
  const glm::dvec3 colour = glm::clamp(source.baseColour, 0.0, 1.0);

  // The metallic share of a material is opaque.
  const double transmission = source.transmission * (1 - source.metallic);
  if (transmission > 0 && transmission <= prep::kTransmissive)
    prep::addNote(notes, fmt::format("the transmission of material '{}', at most half of the light", source.name));

  // A surface has either emission or reflection.
  const bool isEmitter = largest(source.emissive) > kLeastEmission * largest(colour);
  if (isEmitter) {
    result.kind = Kind::emitter;
    result.radiance = glm::clamp(source.emissive, 0.0, kMostRadiance);
    result.twoSided = source.isDoubleSided;
    result.illuminates = true;
    if (largest(source.emissive) < kBrightEmission * largest(colour))
      prep::addNote(notes, fmt::format("the reflection of material '{}', which emits light", source.name));
    if (source.alphaMode != prep::AlphaMode::opaque)
      prep::addNote(notes, fmt::format("the alpha of material '{}', which is drawn as opaque", source.name));
    if (transmission > prep::kTransmissive)
      prep::addNote(notes, fmt::format("the transmission of material '{}', which emits light", source.name));
    return result;
  }
  const bool isPane =
      source.alphaMode == prep::AlphaMode::blend && source.alpha < kOpaqueAlpha && transmission <= prep::kTransmissive;
  if (source.alphaMode != prep::AlphaMode::opaque)
    prep::addNote(notes, fmt::format("the alpha of material '{}', which is drawn as {}", source.name,
                                     isPane ? "thin glass" : "opaque"));
  if (isPane) {
    result.kind = Kind::thinGlass;
    result.eta = dielectricIndex(source);
    result.transmittanceParallel = 1.0 - source.alpha * (1.0 - colour);
  } else if (transmission > prep::kTransmissive) {
    result.kind = source.isThinWalled ? Kind::thinGlass : Kind::glass;
    result.eta = dielectricIndex(source);
    if (source.tintsTransmission) result.transmittanceParallel = colour;
    if (source.hasVolume) result.absorption = volumeAbsorption(source);
    if (alpha > 0) prep::addNote(notes, fmt::format("the roughness of glass '{}'", source.name));
    if (transmission < 1) prep::addNote(notes, fmt::format("the opaque part of glass '{}'", source.name));
  } else if (source.metallic >= 0.5) {
    result.kind = Kind::metal;
    setMetal(result, colour);
    result.roughness = std::min(alpha, 1.0);
  } else {
    setOpaqueDielectric(source, alpha, result);
  }
  if (source.emissive != glm::dvec3(0.0)) {
    if (pack::canBeDiffuse(result.kind))
      result.radiance = glm::clamp(source.emissive, 0.0, kMostRadiance);
    else
      prep::addNote(notes, fmt::format("the faint emission of material '{}'", source.name));
  }
  addLayers(source, result, notes);
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
