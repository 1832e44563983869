#include "meshprep/read/gltf_material.h"

#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::prep {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Reader {
 public:
  Reader(const tinygltf::Material& material, const std::string& place) : material_(material), place_(place) {}

  double bounded(std::string_view key, double value, double low, double high) const {
    if (!(value >= low && value <= high))
      throw Error(fmt::format("{}.{}", place_, key), "is out of range",
                  high == kInfinity ? fmt::format("{} or more", low) : fmt::format("{} to {}", low, high),
                  fmt::to_string(value));
    return value;
  }

  glm::dvec3 colour(std::string_view key, const std::vector<double>& values, double high) const {
    glm::dvec3 colour{};
    for (int i = 0; i < 3; ++i) colour[i] = bounded(key, values[static_cast<std::size_t>(i)], 0, high);
    return colour;
  }

  // An extension of the material; nullptr where it has none.
  const tinygltf::Value* extension(const char* name) const {
    const auto found = material_.extensions.find(name);
    return found == material_.extensions.end() ? nullptr : &found->second;
  }

  static double number(const tinygltf::Value& object, const char* key, double fallback) {
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
  }

 private:
  const tinygltf::Material& material_;
  const std::string& place_;
};

}  // namespace

SourceMaterial gltfMaterial(const tinygltf::Material& material, const std::string& place,
                            std::vector<std::string>& notes) {
  const Reader reader(material, place);
  SourceMaterial result;
  result.name = material.name;

  // Step 1: metallic-roughness and emission. tinygltf gives the defaults.
  const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
  result.baseColour = reader.colour("pbrMetallicRoughness.baseColorFactor", pbr.baseColorFactor, 1);
  result.metallic = reader.bounded("pbrMetallicRoughness.metallicFactor", pbr.metallicFactor, 0, 1);
  result.roughness = reader.bounded("pbrMetallicRoughness.roughnessFactor", pbr.roughnessFactor, 0, 1);
  result.emissive = reader.colour("emissiveFactor", material.emissiveFactor, 1);
  if (!material.alphaMode.empty() && material.alphaMode != "OPAQUE") addNote(notes, "coverage by alpha");

  // Step 2: extensions.
  if (const auto* strength = reader.extension("KHR_materials_emissive_strength"); strength != nullptr)
    result.emissive *= reader.bounded("emissiveStrength", Reader::number(*strength, "emissiveStrength", 1), 0, 1e12);
  if (const auto* ior = reader.extension("KHR_materials_ior"); ior != nullptr) {
    const double value = Reader::number(*ior, "ior", 1.5);
    result.ior = value == 0 ? 1.5 : reader.bounded("ior", value, 1, kInfinity);
  }
  if (const auto* transmission = reader.extension("KHR_materials_transmission"); transmission != nullptr)
    result.transmission =
        reader.bounded("transmissionFactor", Reader::number(*transmission, "transmissionFactor", 0), 0, 1);
  if (const auto* volume = reader.extension("KHR_materials_volume"); volume != nullptr) {
    result.hasVolume = Reader::number(*volume, "thicknessFactor", 0) > 0;
    if (volume->Has("attenuationColor")) {
      std::vector<double> colour(3);
      for (int i = 0; i < 3; ++i)
        colour[static_cast<std::size_t>(i)] = volume->Get("attenuationColor").Get(i).GetNumberAsDouble();
      result.attenuationColour = reader.colour("attenuationColor", colour, 1);
    }
    result.attenuationDistance = Reader::number(*volume, "attenuationDistance", kInfinity);
    if (!(result.attenuationDistance > 0))
      throw Error(place + ".attenuationDistance", "is out of range", "more than 0 metres",
                  fmt::to_string(result.attenuationDistance));
  }
  if (result.transmission > 0 && !result.hasVolume) addNote(notes, "that walls without a volume are thin");
  return result;
}

}  // namespace malus::prep
