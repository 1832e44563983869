// Transmission textures (KHR_materials_transmission) of thin walls.
#include <algorithm>

#include <fmt/format.h>

#include "bake/materials/material_maps.h"
#include "bake/materials/source_material.h"

namespace malus::bake {

std::optional<MaterialMaps::Split> MaterialMaps::split(const prep::SourceMaterial& factors,
                                                       const prep::SourceMaterial& means) {
  const Decoded* image = decode(factors.transmissionImage);
  if (image == nullptr) return {};

  // Count the texels that transmit, and their mean.
  const auto transmission = [&](const Decoded& source, std::size_t i) {
    return factors.transmission * std::clamp(source.number(i, 0), 0.0, 1.0);
  };
  const double dielectric = 1 - std::clamp(means.metallic, 0.0, 1.0);
  std::size_t clear = 0;
  double sum = 0;
  for (std::size_t i = 0; i < image->pixels(); ++i) {
    const double t = transmission(*image, i);
    if (t * dielectric <= prep::kTransmissive) continue;
    ++clear;
    sum += t;
  }
  if (clear == 0 || clear == image->pixels()) return {};

  // A surface has one coverage, and the opaque part of a body would be seen from the inside too.
  const Decoded* colours = decode(factors.baseColourImage);
  const bool hasAlpha = factors.alphaMode != prep::AlphaMode::opaque &&
                        (factors.coverageImage.has_value() || (colours != nullptr && colours->alpha));
  prep::SourceMaterial part = means;
  part.transmission = sum / static_cast<double>(clear);
  std::vector<std::string> unused;
  if (hasAlpha || convertMaterial(part, unused).kind != pack::MaterialKind::thinGlass) {
    prep::addNote(notes_, fmt::format("the variation of the transmission texture of material '{}', whose mean is used",
                                      factors.name));
    return {};
  }
  prep::addNote(notes_, fmt::format("{}the transmission texture of material '{}': thin glass where it transmits more "
                                    "than {} of the light, opaque elsewhere",
                                    prep::kAcceptedNote, factors.name, prep::kTransmissive));

  Split result;
  result.clear = convert(factors, part);
  part.transmission = 0;
  result.opaque = convert(factors, part);
  const auto cover = [&](pack::Material& material, bool isClear) {
    material.meshMaps.cutoff = prep::kTransmissive;
    material.meshMaps.coverage =
        add(*factors.transmissionImage, factors.transmissionPlacement,
            fmt::format("{}: {} {}", isClear ? "transmission" : "opaque", factors.transmission, dielectric),
            [&](const Decoded& source, std::size_t i) {
              const auto t = static_cast<float>(transmission(source, i) * dielectric);
              return glm::vec3(isClear ? t : 1.0f - t);
            });
  };
  cover(result.clear, true);
  cover(result.opaque, false);
  decoded_.clear();
  return result;
}

}  // namespace malus::bake
