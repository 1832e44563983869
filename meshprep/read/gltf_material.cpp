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
constexpr double kDefaultIor = 1.5, kDefaultFilmIor = 1.3;
constexpr double kMaxSpecularColour = 1e6;
constexpr double kMaxFilmNm = 1e5;

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

  // Reports a text that is replaced by the default.
  void unknown(std::string_view key, const std::string& value, std::string_view expected) const {
    const Error error(fmt::format("{}.{}", location_, key), "is unknown", expected, "'" + value.substr(0, 40) + "'");
    if (strict_) throw Error(error);
    addNote(notes_, error.what());
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

// Sets colour, metallic and roughness. Specular-glossiness is a dielectric whose reflectance at normal incidence is the
// specular colour, which KHR_materials_specular and an index of 0 (KHR_materials_ior) describe too.
void readBase(const gltf::Material& material, const BoundsCheck& checked, SourceMaterial& result) {
  if (material.specularGlossiness) {
    const gltf::SpecularGlossiness& values = *material.specularGlossiness;
    result.baseColour = checked("diffuseFactor", values.diffuseFactor);
    result.metallic = 0;
    result.roughness = 1 - checked("glossinessFactor", values.glossinessFactor, 0, 1);
    result.ior = 0;
    result.specularColour = checked("specularFactor", values.specularFactor);
    return;
  }
  result.baseColour = checked("pbrMetallicRoughness.baseColorFactor", material.baseColorFactor);
  result.metallic = checked("pbrMetallicRoughness.metallicFactor", material.metallicFactor, 0, 1);
  result.roughness = checked("pbrMetallicRoughness.roughnessFactor", material.roughnessFactor, 0, 1);
  result.ior = material.ior == 0 ? 0 : checked.replaced("ior", material.ior, 1, kInfinity, kDefaultIor);
  result.specular = checked("specularFactor", material.specularFactor, 0, 1);
  for (std::size_t i = 0; i < 3; ++i)
    result.specularColour[static_cast<int>(i)] =
        checked("specularColorFactor", material.specularColorFactor[i], 0, kMaxSpecularColour);
}

SourceWrap toWrap(std::size_t number) {
  if (number == gltf::Sampler::kClampToEdge) return SourceWrap::clamp;
  return number == gltf::Sampler::kMirroredRepeat ? SourceWrap::mirror : SourceWrap::repeat;
}

// Sets the image of a texture and its place, if the image is in the file.
class TextureReader {
 public:
  TextureReader(const gltf::Document& document, const gltf::Material& material, std::vector<std::string>& notes)
      : document_(document), material_(material), notes_(notes) {}

  void operator()(const gltf::TextureInfo& info, std::optional<std::size_t>& image, SourcePlacement& place) const {
    if (!info.index || *info.index >= document_.textures.size()) return;
    const gltf::Texture& texture = document_.textures[*info.index];
    if (!texture.source || *texture.source >= document_.images.size()) return;
    image = texture.source;
    place.set = info.texCoord;
    if (info.texCoord > 1) {
      addNote(notes_, fmt::format("TEXCOORD_{} of material '{}', in place of which TEXCOORD_0 is used", info.texCoord,
                                  material_.name));
      place.set = 0;
    }
    if (texture.sampler && *texture.sampler < document_.samplers.size()) {
      place.wrapU = toWrap(document_.samplers[*texture.sampler].wrapS);
      place.wrapV = toWrap(document_.samplers[*texture.sampler].wrapT);
    }
    place.offset = {info.offset[0], info.offset[1]};
    place.scale = {info.scale[0], info.scale[1]};
    place.rotation = info.rotation;
  }

 private:
  const gltf::Document& document_;
  const gltf::Material& material_;
  std::vector<std::string>& notes_;
};

// Sets the images of the textures. Those of metallic-roughness do not apply to specular-glossiness.
void readTextures(const gltf::Document& document, const gltf::Material& material, std::vector<std::string>& notes,
                  SourceMaterial& result) {
  const TextureReader read(document, material, notes);
  read(material.emissiveTexture, result.emissiveImage, result.emissivePlacement);
  read(material.normalTexture, result.normalImage, result.normalPlacement);
  result.normalScale = material.normalScale;
  read(material.transmissionTexture, result.transmissionImage, result.transmissionPlacement);
  if (material.normalTexture.index && !result.normalImage)
    addNote(notes, fmt::format("the normal texture of material '{}', which cannot be read", material.name));
  if (material.transmissionTexture.index && !result.transmissionImage)
    addNote(notes, fmt::format("the transmission texture of material '{}', which cannot be read", material.name));
  if (material.specularGlossiness) {
    read(material.specularGlossiness->diffuseTexture, result.baseColourImage, result.baseColourPlacement);
    read(material.specularGlossiness->specularGlossinessTexture, result.specularGlossinessImage,
         result.specularGlossinessPlacement);
  } else {
    read(material.baseColorTexture, result.baseColourImage, result.baseColourPlacement);
    read(material.metallicRoughnessTexture, result.metallicRoughnessImage, result.metallicRoughnessPlacement);
  }
  // A texture without an image that can be read, such as KTX2: most of a mask of emission is black.
  if (!material.emissiveTexture.index || result.emissiveImage || result.emissive == glm::dvec3(0.0)) return;
  result.emissive = glm::dvec3(0.0);
  addNote(notes, fmt::format("the emission of material '{}', whose emissive texture cannot be read", material.name));
}

void readEmission(const gltf::Material& material, const BoundsCheck& checked, std::vector<std::string>& notes,
                  SourceMaterial& result) {
  for (std::size_t i = 0; i < 3; ++i)
    result.emissive[static_cast<int>(i)] = checked("emissiveFactor", material.emissiveFactor[i], 0, kMaxEmission);
  if (result.emissive.x > 1 || result.emissive.y > 1 || result.emissive.z > 1)
    addNote(notes, std::string(kAcceptedNote) + "emissive factors above 1");
  result.emissive *= checked("emissiveStrength", material.emissiveStrength, 0, kMaxEmission);
}

void readAlpha(const gltf::Material& material, const BoundsCheck& checked, SourceMaterial& result) {
  const double alpha =
      material.specularGlossiness ? material.specularGlossiness->diffuseFactor[3] : material.baseColorFactor[3];
  result.alpha = checked("alpha", alpha, 0, 1);
  result.alphaCutoff = checked.replaced("alphaCutoff", material.alphaCutoff, 0, kInfinity, 0.5);
  if (material.alphaMode == "MASK")
    result.alphaMode = AlphaMode::mask;
  else if (material.alphaMode == "BLEND")
    result.alphaMode = AlphaMode::blend;
  else if (material.alphaMode != "OPAQUE")
    checked.unknown("alphaMode", material.alphaMode, "OPAQUE, MASK or BLEND");
}

// Sets transmission, volume and layers.
void readDielectric(const gltf::Material& material, const BoundsCheck& checked, SourceMaterial& result) {
  result.transmission = checked("transmissionFactor", material.transmissionFactor, 0, 1);
  result.hasVolume = material.volumeThicknessFactor > 0;
  result.attenuationColour = checked("attenuationColor", material.attenuationColor);
  result.attenuationDistance = checked.replaced("attenuationDistance", material.attenuationDistance,
                                                std::numeric_limits<double>::min(), kInfinity, kInfinity);
  // Without a volume, or with one of thickness 0, KHR_materials_volume makes the material thin-walled.
  result.isThinWalled = result.transmission > 0 && !result.hasVolume;
  result.tintsTransmission = result.transmission > 0;
  result.clearcoat = checked("clearcoatFactor", material.clearcoatFactor, 0, 1);
  result.clearcoatRoughness = checked("clearcoatRoughnessFactor", material.clearcoatRoughnessFactor, 0, 1);
  result.film = checked("iridescenceFactor", material.iridescenceFactor, 0, 1);
  result.filmIor = checked.replaced("iridescenceIor", material.iridescenceIor, 1, kInfinity, kDefaultFilmIor);
  result.filmThicknessNm = checked("iridescenceThicknessMaximum", material.iridescenceThicknessMaximum, 0, kMaxFilmNm);
}

}  // namespace

SourceMaterial gltfMaterial(const gltf::Document& document, const gltf::Material& material, const std::string& location,
                            std::vector<std::string>& notes, bool strict) {
  const BoundsCheck checked(location, notes, strict);
  SourceMaterial result;
  result.name = material.name;

  readBase(material, checked, result);
  readEmission(material, checked, notes, result);
  readDielectric(material, checked, result);
  readTextures(document, material, notes, result);
  result.isDoubleSided = material.doubleSided;
  readAlpha(material, checked, result);
  return result;
}

}  // namespace malus::prep
