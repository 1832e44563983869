#include "bake/materials/material_maps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "bake/materials/source_material.h"
#include "bake/pack/format.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image_colour.h"
#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

using pack::MaterialKind;

constexpr double kMetallic = 0.5;  // as of convertMaterial()
constexpr double kSharpAlpha = 0.1;
constexpr double kBlendCutoff = 0.5;

pack::MeshMap place(std::int32_t texture, const prep::SourcePlacement& p) {
  pack::MeshMap map;
  map.texture = texture;
  map.set = static_cast<std::uint32_t>(p.set);
  map.wrapU = static_cast<pack::Wrap>(p.wrapU);
  map.wrapV = static_cast<pack::Wrap>(p.wrapV);
  const double c = std::cos(p.rotation), s = std::sin(p.rotation);
  map.u = {c * p.scale.x, s * p.scale.y, p.offset.x};
  map.v = {-s * p.scale.x, c * p.scale.y, p.offset.y};
  return map;
}

std::string key(const glm::dvec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

double unit(double x) { return std::clamp(x, 0.0, 1.0); }

glm::vec3 grey(double x) { return glm::vec3(static_cast<float>(x)); }

}  // namespace

double MaterialMaps::Decoded::number(std::size_t pixel, std::size_t colour) const {
  return static_cast<double>(image.pixels[pixel * image.channels.size() + colours[colour]]);
}
double MaterialMaps::Decoded::colour(std::size_t pixel, std::size_t colour) const {
  return image::decodeSrgb(number(pixel, colour));
}
double MaterialMaps::Decoded::coverage(std::size_t pixel) const {
  return alpha ? unit(static_cast<double>(image.pixels[pixel * image.channels.size() + *alpha])) : 1;
}

// Notes about images that cannot be read are those of applyTextureMeans().
const MaterialMaps::Decoded* MaterialMaps::decode(const std::optional<std::size_t>& index) {
  if (!index) return nullptr;
  const auto [found, isNew] = decoded_.try_emplace(*index);
  if (!isNew) return found->second ? &*found->second : nullptr;
  const prep::SourceImage& source = images_[*index];
  try {
    if (source.file.empty() && !source.bytes) return nullptr;
    const std::string name = source.bytes ? source.name : source.file.string();
    Decoded decoded;
    decoded.image = source.bytes ? image::readBytes(*source.bytes, name) : image::read(source.file);
    if (std::max(decoded.image.width, decoded.image.height) > static_cast<int>(pack::kMaxTextureSide))
      throw Error(name, "is too large for a texture", fmt::format("at most {0} x {0} texels", pack::kMaxTextureSide),
                  fmt::format("{} x {}", decoded.image.width, decoded.image.height));
    for (const char* channel : {"R", "G", "B"}) {
      const int at = decoded.image.channel(channel);
      decoded.colours.push_back(at < 0 ? 0 : static_cast<std::size_t>(at));  // of grey: the first channel
    }
    if (const int at = decoded.image.channel("A"); at >= 0) decoded.alpha = static_cast<std::size_t>(at);
    found->second = std::move(decoded);
  } catch (const Error& error) {
    if (strict_) throw;
    prep::addNote(notes_, error.what());
    return nullptr;
  }
  return &*found->second;
}

// Makes a texture of the size of an image, with a value per texel, or finds the one that was made before. recipe: how
// the texels are made.
pack::MeshMap MaterialMaps::add(std::size_t image, const prep::SourcePlacement& where, const std::string& recipe,
                                const Texel& texel) {
  const std::string name = fmt::format("{} {}", image, recipe);
  if (const auto found = made_.find(name); found != made_.end()) return place(found->second, where);
  const Decoded& source = *decode(image);
  pack::Texture texture;
  texture.name = fmt::format("{} ({})", images_[image].name, recipe.substr(0, recipe.find(':')));
  texture.width = static_cast<std::uint32_t>(source.image.width);
  texture.height = static_cast<std::uint32_t>(source.image.height);
  texture.texels.reserve(source.pixels());
  for (std::size_t i = 0; i < source.pixels(); ++i) texture.texels.emplace_back(texel(source, i));
  if (textures_.size() >= pack::kMaxTextures)
    throw Error(images_[image].name, "the scene has too many textures", fmt::format("at most {}", pack::kMaxTextures));
  const auto index = static_cast<std::int32_t>(textures_.size());
  textures_.push_back(std::move(texture));
  made_.emplace(name, index);
  return place(index, where);
}

// Whether texels of the metallic-roughness image are metallic and others are not.
bool MaterialMaps::isMixed(const prep::SourceMaterial& factors) {
  const Decoded* image = decode(factors.metallicRoughnessImage);
  if (image == nullptr || factors.metallic < kMetallic) return false;
  std::size_t metallic = 0;
  for (std::size_t i = 0; i < image->pixels(); ++i)
    metallic += factors.metallic * unit(image->number(i, 2)) >= kMetallic ? 1 : 0;
  return metallic > 0 && metallic < image->pixels();
}

bool MaterialMaps::hasSharpAlpha(const prep::SourceMaterial& factors) {
  const Decoded* image = decode(factors.baseColourImage);
  if (image == nullptr || !image->alpha) return false;
  std::size_t partial = 0;
  for (std::size_t i = 0; i < image->pixels(); ++i) {
    const double a = image->coverage(i);
    partial += a > kSharpAlpha && a < 1 - kSharpAlpha ? 1 : 0;
  }
  return static_cast<double>(partial) <= kSharpAlpha * static_cast<double>(image->pixels());
}

void MaterialMaps::addCoverage(const prep::SourceMaterial& factors, pack::Material& material) {
  pack::MeshMaps& maps = material.meshMaps;
  maps.cutoff = factors.alphaMode == prep::AlphaMode::blend ? kBlendCutoff : factors.alphaCutoff;
  if (decode(factors.coverageImage) != nullptr) {
    maps.coverage = add(*factors.coverageImage, factors.coveragePlacement, fmt::format("coverage: {}", factors.alpha),
                        [&](const Decoded& image, std::size_t i) {
                          return grey(factors.alpha * (image.alpha ? image.coverage(i) : unit(image.number(i, 0))));
                        });
  } else if (const Decoded* image = decode(factors.baseColourImage); image != nullptr && image->alpha) {
    maps.coverage =
        add(*factors.baseColourImage, factors.baseColourPlacement, fmt::format("coverage: {}", factors.alpha),
            [&](const Decoded& source, std::size_t i) { return grey(factors.alpha * source.coverage(i)); });
  }
}

void MaterialMaps::addNormal(const prep::SourceMaterial& factors, pack::Material& material) {
  if (decode(factors.normalImage) == nullptr) return;
  material.meshMaps.normalScale = std::clamp(factors.normalScale, -100.0, 100.0);
  material.meshMaps.normal =
      add(*factors.normalImage, factors.normalPlacement, "normal", [](const Decoded& image, std::size_t i) {
        return glm::vec3(unit(image.number(i, 0)), unit(image.number(i, 1)), unit(image.number(i, 2)));
      });
}

void MaterialMaps::addRadiance(const prep::SourceMaterial& factors, pack::Material& material) {
  if (material.radiance == glm::dvec3(0.0) || decode(factors.emissiveImage) == nullptr) return;
  const glm::dvec3 factor = glm::clamp(factors.emissive, 0.0, pack::kMaxLight);
  material.meshMaps.radiance =
      add(*factors.emissiveImage, factors.emissivePlacement, "radiance: " + key(factor),
          [&](const Decoded& image, std::size_t i) {
            return glm::vec3(factor * glm::dvec3(image.colour(i, 0), image.colour(i, 1), image.colour(i, 2)));
          });
}

namespace {

// Colour of a texel, its factor included.
template <class Image>
glm::dvec3 baseColour(const prep::SourceMaterial& factors, const Image& image, std::size_t i) {
  return glm::clamp(factors.baseColour * glm::dvec3(image.colour(i, 0), image.colour(i, 1), image.colour(i, 2)), 0.0,
                    1.0);
}

}  // namespace

void MaterialMaps::addRoughness(const prep::SourceMaterial& factors, pack::Material& material) {
  if (!pack::canBeRough(material.kind) || decode(factors.metallicRoughnessImage) == nullptr) return;
  material.meshMaps.roughness =
      add(*factors.metallicRoughnessImage, factors.metallicRoughnessPlacement,
          fmt::format("roughness: {}", factors.roughness), [&](const Decoded& image, std::size_t i) {
            return grey(std::min(facetAlpha(factors.roughness * unit(image.number(i, 1))), 1.0));
          });
}

// The base colour as albedo, or as transmittance of thin glass or of the surface of a body.
void MaterialMaps::addColour(const prep::SourceMaterial& factors, const prep::SourceMaterial& means,
                             pack::Material& material) {
  pack::MeshMaps& maps = material.meshMaps;
  const bool isBlended = material.kind == MaterialKind::thinGlass && factors.alphaMode == prep::AlphaMode::blend &&
                         means.transmission * (1 - means.metallic) <= prep::kTransmissive;
  const bool isClear = isBlended || (pack::isClear(material.kind) && factors.tintsTransmission);
  if (decode(factors.baseColourImage) != nullptr && (pack::canBeDiffuse(material.kind) || isClear)) {
    const std::string recipe = fmt::format("{}: {} {}", isClear ? "transmittance" : "albedo", key(factors.baseColour),
                                           isBlended ? factors.alpha : -1);
    (isClear ? maps.transmittance : maps.albedo) =
        add(*factors.baseColourImage, factors.baseColourPlacement, recipe, [&](const Decoded& image, std::size_t i) {
          const glm::dvec3 colour = baseColour(factors, image, i);
          return glm::vec3(isBlended ? 1.0 - factors.alpha * image.coverage(i) * (1.0 - colour) : colour);
        });
  }
}

// A metal whose reflectance is the base colour.
void MaterialMaps::addMetal(const prep::SourceMaterial& factors, pack::Material& material) {
  if (decode(factors.baseColourImage) == nullptr) return;
  material.meshMaps.reflectance =
      add(*factors.baseColourImage, factors.baseColourPlacement, "reflectance: " + key(factors.baseColour),
          [&](const Decoded& image, std::size_t i) { return glm::vec3(baseColour(factors, image, i)); });
}

std::size_t MaterialMaps::nearestPixel(const Decoded& from, std::size_t i, const Decoded& to) {
  const auto width = static_cast<std::size_t>(from.image.width), height = static_cast<std::size_t>(from.image.height);
  const std::size_t x = (2 * (i % width) + 1) * static_cast<std::size_t>(to.image.width) / (2 * width),
                    y = (2 * (i / width) + 1) * static_cast<std::size_t>(to.image.height) / (2 * height);
  return y * static_cast<std::size_t>(to.image.width) + x;
}

// A material whose metallic varies. The texels are those of the metallic-roughness image; the base colour is that of
// the nearest texel of its image, which must be placed alike.
void MaterialMaps::addMixed(const prep::SourceMaterial& factors, const prep::SourceMaterial& means,
                            pack::Material& material) {
  const Decoded* colours = decode(factors.baseColourImage);
  const bool isPlacedAlike = factors.baseColourPlacement == factors.metallicRoughnessPlacement;
  if (colours != nullptr && !isPlacedAlike) {
    prep::addNote(notes_, fmt::format("the base colour texture of material '{}', which is placed differently than its "
                                      "metallic texture; its mean is used",
                                      factors.name));
    colours = nullptr;
  }
  const glm::dvec3 dielectric = normalReflectance(factors);
  // The larger image has the texels of the other that are nearest.
  const Decoded& numbers = *decode(factors.metallicRoughnessImage);
  const bool byColours = colours != nullptr && colours->pixels() > numbers.pixels();
  const std::size_t image = byColours ? *factors.baseColourImage : *factors.metallicRoughnessImage;
  const auto colourAt = [&](const Decoded& from, std::size_t i) {
    return colours == nullptr ? glm::clamp(means.baseColour, 0.0, 1.0)
                              : baseColour(factors, *colours, nearestPixel(from, i, *colours));
  };
  const auto metallicAt = [&](const Decoded& from, std::size_t i) {
    return unit(factors.metallic * unit(numbers.number(nearestPixel(from, i, numbers), 2)));
  };
  const std::string others =
      fmt::format("{} {} {} {} {}", factors.metallic, key(colours == nullptr ? means.baseColour : factors.baseColour),
                  key(dielectric), *factors.metallicRoughnessImage, colours == nullptr ? -1 : 1);
  const prep::SourcePlacement& where = factors.metallicRoughnessPlacement;
  pack::MeshMaps& maps = material.meshMaps;
  maps.metallic = add(image, where, "metallic: " + others,
                      [&](const Decoded& from, std::size_t i) { return grey(metallicAt(from, i)); });
  maps.reflectance = add(image, where, "mixed reflectance: " + others, [&](const Decoded& from, std::size_t i) {
    return glm::vec3(glm::mix(dielectric, colourAt(from, i), metallicAt(from, i)));
  });
  maps.albedo = add(image, where, "mixed albedo: " + others, [&](const Decoded& from, std::size_t i) {
    return glm::vec3(colourAt(from, i) * (1 - metallicAt(from, i)));
  });

  // The constants are those of the means.
  const double metallic = unit(means.metallic);
  material.kind = MaterialKind::metal;
  material.albedo = glm::clamp(means.baseColour, 0.0, 1.0) * (1 - metallic);
  material.roughness = std::min(facetAlpha(means.roughness), 1.0);
  for (int c = 0; c < 3; ++c) {
    const double r = std::clamp(glm::mix(dielectric[c], unit(means.baseColour[c]), metallic), f64::kLeastReflectance,
                                f64::kMostReflectance);
    const f64::ConductorIndex index = f64::conductorIndex(r, metallic);
    material.eta[c] = index.eta;
    material.k[c] = index.k;
  }
}

pack::Material MaterialMaps::convert(prep::SourceMaterial factors, prep::SourceMaterial means) {
  // Cut out by alpha, or blend.
  const bool hasAlpha = decode(factors.coverageImage) != nullptr ||
                        (decode(factors.baseColourImage) != nullptr && decode(factors.baseColourImage)->alpha);
  const bool isSharp = factors.alphaMode == prep::AlphaMode::blend && hasSharpAlpha(factors);
  const bool isCutOut = hasAlpha && (factors.alphaMode == prep::AlphaMode::mask || isSharp);
  if (isSharp)
    prep::addNote(notes_, fmt::format("{}the blended alpha of material '{}', cut out below {}", prep::kAcceptedNote,
                                      factors.name, kBlendCutoff));
  if (isCutOut) means.alphaMode = prep::AlphaMode::opaque;

  std::vector<std::string> notes;
  pack::Material material = convertMaterial(means, notes);
  const bool isMetal = material.kind == MaterialKind::metal && means.metallic >= kMetallic;
  const bool isDielectric = material.kind == MaterialKind::lambert || material.kind == MaterialKind::paint;
  const bool isMixedMetal = (isMetal || isDielectric) && isMixed(factors);
  if (isMixedMetal && !isMetal) {  // with the layers of a metal
    prep::SourceMaterial metal = means;
    metal.metallic = 1;
    notes.clear();
    material = convertMaterial(metal, notes);
  }
  if (isMixedMetal && means.specular < 1)
    notes.push_back(fmt::format("the specular factor of material '{}', which is a metal in part", means.name));
  for (std::string& note : notes) prep::addNote(notes_, std::move(note));
  if (!pack::isEmitter(material.kind)) addRoughness(factors, material);
  if (isMixedMetal)
    addMixed(factors, means, material);
  else if (isMetal)
    addMetal(factors, material);
  else
    addColour(factors, means, material);
  addSpecular(factors, means, material);
  if (isCutOut) addCoverage(factors, material);
  addRadiance(factors, material);
  if (!pack::isEmitter(material.kind)) addNormal(factors, material);
  decoded_.clear();
  return material;
}

}  // namespace malus::bake
