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

  // Metallic texels do not transmit: the frame of a window. The larger image has the texels of the other that are
  // nearest.
  const bool isMixedMetal = isMixed(factors) && factors.metallicRoughnessPlacement == factors.transmissionPlacement;
  const Decoded* numbers = isMixedMetal ? decode(factors.metallicRoughnessImage) : nullptr;
  const bool byNumbers = isMixedMetal && numbers->pixels() > image->pixels();
  const Decoded& larger = byNumbers ? *numbers : *image;
  const auto transmission = [&](const Decoded& from, std::size_t i) {
    return factors.transmission * std::clamp(image->number(nearestPixel(from, i, *image), 0), 0.0, 1.0);
  };
  const auto dielectric = [&](const Decoded& from, std::size_t i) {
    if (!isMixedMetal) return 1 - std::clamp(means.metallic, 0.0, 1.0);
    return 1 - std::clamp(factors.metallic * numbers->number(nearestPixel(from, i, *numbers), 2), 0.0, 1.0);
  };

  // Count the texels that transmit, and their mean.
  std::size_t clear = 0;
  double sum = 0;
  for (std::size_t i = 0; i < larger.pixels(); ++i) {
    const double t = transmission(larger, i);
    if (t * dielectric(larger, i) <= prep::kTransmissive) continue;
    ++clear;
    sum += t;
  }
  if (clear == 0 || clear == larger.pixels()) return {};

  // A surface has one coverage, and the opaque part of a body would be seen from the inside too.
  const Decoded* colours = decode(factors.baseColourImage);
  const bool hasAlpha = factors.alphaMode != prep::AlphaMode::opaque &&
                        (factors.coverageImage.has_value() || (colours != nullptr && colours->alpha));
  prep::SourceMaterial part = means;
  part.transmission = sum / static_cast<double>(clear);
  if (isMixedMetal) part.metallic = 0;
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
  part.metallic = means.metallic;
  result.opaque = convert(factors, part);
  image = decode(factors.transmissionImage);  // convert() drops what was decoded
  if (isMixedMetal) numbers = decode(factors.metallicRoughnessImage);
  const auto cover = [&](pack::Material& material, bool isClear) {
    material.meshMaps.cutoff = prep::kTransmissive;
    material.meshMaps.coverage =
        add(byNumbers ? *factors.metallicRoughnessImage : *factors.transmissionImage, factors.transmissionPlacement,
            fmt::format("{}: {} {} {} {}", isClear ? "transmission" : "opaque", factors.transmission,
                        *factors.transmissionImage, isMixedMetal ? factors.metallic : means.metallic,
                        isMixedMetal ? static_cast<int>(*factors.metallicRoughnessImage) : -1),
            [&](const Decoded& source, std::size_t i) {
              const auto t = static_cast<float>(transmission(source, i) * dielectric(source, i));
              return glm::vec3(isClear ? t : 1.0f - t);
            });
  };
  cover(result.clear, true);
  cover(result.opaque, false);
  decoded_.clear();
  return result;
}

}  // namespace malus::bake
