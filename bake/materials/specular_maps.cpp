// Maps of specular-glossiness: KHR_materials_pbrSpecularGlossiness defines the reflectance at normal incidence as the
// specular colour and GGX alpha as (1 - glossiness)^2.
#include <algorithm>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "bake/materials/material_maps.h"
#include "bake/materials/source_material.h"
#include "meshprep/base/image_colour.h"
#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

using pack::MaterialKind;

// The index of a metal or, without an edge tint, of a dielectric.
void setIndex(pack::Material& material, const glm::dvec3& reflectance, double tint) {
  for (int c = 0; c < 3; ++c) {
    const double r = std::clamp(reflectance[c], f64::kLeastReflectance, f64::kMostReflectance);
    const f64::ConductorIndex index = f64::conductorIndex(r, tint);
    material.eta[c] = index.eta;
    material.k[c] = index.k;
  }
}

// (1 + sqrt r)/(1 - sqrt r), as dielectricIndex() of source_material.cpp.
glm::dvec3 indexOf(const glm::dvec3& reflectance) {
  const glm::dvec3 root = glm::sqrt(reflectance);
  return glm::clamp((1.0 + root) / glm::max(1.0 - root, 1e-3), 1.0, pack::kMaxEta);
}

}  // namespace

void MaterialMaps::addSpecular(const prep::SourceMaterial& factors, const prep::SourceMaterial& means,
                               pack::Material& material) {
  const Decoded* image = decode(factors.specularGlossinessImage);
  if (image == nullptr) return;
  const bool isOpaque = material.kind == MaterialKind::lambert || material.kind == MaterialKind::paint ||
                        material.kind == MaterialKind::metal;
  if (!isOpaque || means.clearcoat > 0) {
    prep::addNote(notes_,
                  fmt::format("the variation of the specular-glossiness texture of material '{}', whose mean is "
                              "used",
                              factors.name));
    return;
  }
  const auto reflectance = [&](const Decoded& source, std::size_t i) {
    prep::SourceMaterial texel = factors;
    texel.specularColour *= glm::dvec3(source.colour(i, 0), source.colour(i, 1), source.colour(i, 2));
    return normalReflectance(texel);
  };
  std::size_t metallic = 0;
  for (std::size_t i = 0; i < image->pixels(); ++i) metallic += isMetallicReflectance(reflectance(*image, i)) ? 1 : 0;

  const std::size_t index = *factors.specularGlossinessImage;
  const prep::SourcePlacement& where = factors.specularGlossinessPlacement;
  const std::string recipe =
      fmt::format("{} {} {}", factors.specularColour.x, factors.specularColour.y, factors.specularColour.z);
  pack::MeshMaps& maps = material.meshMaps;
  if (metallic > 0) {
    const bool isMixed = metallic < image->pixels();
    const double tint = isMetallicReflectance(normalReflectance(means)) ? 1 : 0;
    if (isMixed || material.kind != MaterialKind::metal) setIndex(material, normalReflectance(means), tint);
    material.kind = MaterialKind::metal;
    material.roughness = std::min(facetAlpha(means.roughness), 1.0);
    maps.reflectance = add(index, where, "specular reflectance: " + recipe,
                           [&](const Decoded& source, std::size_t i) { return glm::vec3(reflectance(source, i)); });
    if (isMixed)
      maps.metallic = add(index, where, "specular metallic: " + recipe, [&](const Decoded& source, std::size_t i) {
        return glm::vec3(isMetallicReflectance(reflectance(source, i)) ? 1.0f : 0.0f);
      });
  } else if (material.kind == MaterialKind::paint) {
    maps.eta = add(index, where, "specular eta: " + recipe,
                   [&](const Decoded& source, std::size_t i) { return glm::vec3(indexOf(reflectance(source, i))); });
  }
  if (metallic == 0 && material.kind == MaterialKind::lambert)
    prep::addNote(notes_, fmt::format("the specular-glossiness texture of material '{}', which is matt on the mean",
                                      factors.name));
  if (pack::canBeRough(material.kind) && image->alpha)
    maps.roughness =
        add(index, where, fmt::format("glossiness: {}", factors.roughness), [&](const Decoded& source, std::size_t i) {
          const double roughness = 1 - (1 - factors.roughness) * source.coverage(i);
          return glm::vec3(static_cast<float>(std::min(facetAlpha(roughness), 1.0)));
        });
}

}  // namespace malus::bake
