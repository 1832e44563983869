#include "meshprep/read/gltf_material.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::prep {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMaxEmission = 1e12;  // of factor and strength
constexpr double kDefaultIor = 1.5;

// Bounds of the numbers of one material.
class BoundsCheck {
 public:
  BoundsCheck(const std::string& location, std::vector<std::string>& notes, bool strict)
      : location_(location), notes_(notes), strict_(strict) {}

  // Returns the value, or `otherwise` if it is out of range.
  double replaced(std::string_view key, double value, double low, double high, double otherwise) const {
    if (value >= low && value <= high) return value;
    const Error error(fmt::format("{}.{}", location_, key), "is out of range",
                      high == kInfinity ? fmt::format("{} or more", low) : fmt::format("{} to {}", low, high),
                      fmt::to_string(value));
    if (strict_) throw Error(error);
    addNote(notes_, fmt::format("{}{}; {} is used", kAcceptedNote, error.what(), otherwise));
    return otherwise;
  }
  // Returns the value, clamped to the range.
  double operator()(std::string_view key, double value, double low, double high) const {
    return replaced(key, value, low, high, std::clamp(value, low, high));
  }

  // Red, green and blue from 0 to 1.
  template <std::size_t n>
  glm::dvec3 operator()(std::string_view key, const std::array<double, n>& color) const {
    return {(*this)(key, color[0], 0, 1), (*this)(key, color[1], 0, 1), (*this)(key, color[2], 0, 1)};
  }

 private:
  const std::string& location_;
  std::vector<std::string>& notes_;
  bool strict_;
};

}  // namespace

SourceMaterial gltfMaterial(const gltf::Material& material, const std::string& location,
                            std::vector<std::string>& notes, bool strict) {
  const BoundsCheck checked(location, notes, strict);
  SourceMaterial result;
  result.name = material.name;

  // Metallic-roughness and emission.
  result.baseColour = checked("pbrMetallicRoughness.baseColorFactor", material.baseColorFactor);
  result.metallic = checked("pbrMetallicRoughness.metallicFactor", material.metallicFactor, 0, 1);
  result.roughness = checked("pbrMetallicRoughness.roughnessFactor", material.roughnessFactor, 0, 1);
  for (std::size_t i = 0; i < 3; ++i)
    result.emissive[static_cast<int>(i)] = checked("emissiveFactor", material.emissiveFactor[i], 0, kMaxEmission);
  if (result.emissive.x > 1 || result.emissive.y > 1 || result.emissive.z > 1)
    addNote(notes, std::string(kAcceptedNote) + "emissive factors above 1");
  result.emissive *= checked("emissiveStrength", material.emissiveStrength, 0, kMaxEmission);
  result.isDoubleSided = material.doubleSided;
  if (material.alphaMode != "OPAQUE") addNote(notes, "alpha coverage");

  // Transmission and volume. KHR_materials_ior reserves 0 for older shading models.
  result.ior = material.ior == 0 ? kDefaultIor : checked.replaced("ior", material.ior, 1, kInfinity, kDefaultIor);
  result.transmission = checked("transmissionFactor", material.transmissionFactor, 0, 1);
  result.hasVolume = material.volumeThicknessFactor > 0;
  result.attenuationColour = checked("attenuationColor", material.attenuationColor);
  result.attenuationDistance = checked.replaced("attenuationDistance", material.attenuationDistance,
                                                std::numeric_limits<double>::min(), kInfinity, kInfinity);
  // Without a volume, or with one of thickness 0, KHR_materials_volume makes the material thin-walled.
  result.isThinWalled = result.transmission > 0 && !result.hasVolume;
  if (result.transmission > 0 && result.hasVolume && result.baseColour != glm::dvec3(1.0))
    addNote(notes, "base colours of transmissive materials with a volume");
  return result;
}

}  // namespace malus::prep
