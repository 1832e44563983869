// Maps of imported materials: their images, texel by texel by the rules that bake/materials/source_material.h applies
// to factors, so that a uniform image gives what the factor gives. Images are decoded by their role in glTF: sRGB for
// colours, as stored for numbers; the metadata of the file is ignored.
//
//   base colour          albedo of lambert and paint; reflectance of metal; of thin glass its transmittance
//   metallic-roughness   roughness of paint and metal. Where texels are metallic (0.5 or more) and others are not, the
//                        material is metal of the reflectance f (1 - metallic) + colour metallic, where f is that of
//                        the dielectric, with the edge tint metallic (conductorIndex in shaders/optics/texture_map.h: 0
//                        is a dielectric, 1 a metal), and of the albedo colour (1 - metallic)
//   emission             radiance of an emitter, or of the layer below the interface
//   specular-glossiness  reflectance, as its index, of paint and metal, and their roughness. A texel with a reflectance
//                        over 0.25 in a colour is a metal, as a factor is; where others are not, the material is metal
//                        with the edge tint 1 or 0. The diffuse colour is the albedo: the light that enters through the
//                        interface is what KHR_materials_pbrSpecularGlossiness approximates by 1 - max(specular)
//   transmission         a thin wall whose texels transmit more than half of the light and others not is two
//                        materials, each cut out where the other one is (split())
//   normal               normal map
//   alpha                of a mask: cut out below its cutoff. Of a blended material: cut out below 0.5 if at most a
//   tenth
//                        of the texels is between 0.1 and 0.9 (kSharpAlpha); otherwise thin glass has the internal
//                        transmittance 1 - a (1 - colour)
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bake/pack/scene.h"
#include "meshprep/base/image.h"
#include "meshprep/read/source_scene.h"

namespace malus::bake {

class MaterialMaps {
 public:
  // images: of the scene. textures: to which those of the maps are added. strict: an image that cannot be read is an
  // Error, not a note.
  MaterialMaps(const std::vector<prep::SourceImage>& images, std::vector<pack::Texture>& textures,
               std::vector<std::string>& notes, bool strict)
      : images_(images), textures_(textures), notes_(notes), strict_(strict) {}

  // Converts a material. factors: as in the file; means: the same, its factors multiplied by the means of the images.
  pack::Material convert(prep::SourceMaterial factors, prep::SourceMaterial means);

  // The materials of the texels of a thin wall that transmit and of those that do not, for two surfaces at the same
  // place; nothing if one of them has no texel, and then, with a note, where the mean of the transmission is used.
  struct Split {
    pack::Material clear, opaque;
  };
  std::optional<Split> split(const prep::SourceMaterial& factors, const prep::SourceMaterial& means);

 private:
  struct Decoded {
    image::Image image;
    std::vector<std::size_t> colours;  // channels of red, green and blue
    std::optional<std::size_t> alpha;  // channel
    std::size_t pixels() const {
      return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    }
    double number(std::size_t pixel, std::size_t colour) const;  // as stored
    double colour(std::size_t pixel, std::size_t colour) const;  // sRGB, decoded
    double coverage(std::size_t pixel) const;                    // alpha; 1 without
  };

  const Decoded* decode(const std::optional<std::size_t>& image);
  // The pixel of an image that is nearest to pixel i of another one, which covers the same.
  static std::size_t nearestPixel(const Decoded& from, std::size_t i, const Decoded& to);
  bool isMixed(const prep::SourceMaterial& factors);
  bool hasSharpAlpha(const prep::SourceMaterial& factors);
  using Texel = std::function<glm::vec3(const Decoded&, std::size_t pixel)>;
  pack::MeshMap add(std::size_t image, const prep::SourcePlacement& place, const std::string& recipe,
                    const Texel& texel);
  void addColour(const prep::SourceMaterial& factors, const prep::SourceMaterial& means, pack::Material& material);
  void addRoughness(const prep::SourceMaterial& factors, pack::Material& material);
  void addMetal(const prep::SourceMaterial& factors, pack::Material& material);
  void addSpecular(const prep::SourceMaterial& factors, const prep::SourceMaterial& means, pack::Material& material);
  void addMixed(const prep::SourceMaterial& factors, const prep::SourceMaterial& means, pack::Material& material);
  void addCoverage(const prep::SourceMaterial& factors, pack::Material& material);
  void addNormal(const prep::SourceMaterial& factors, pack::Material& material);
  void addRadiance(const prep::SourceMaterial& factors, pack::Material& material);

  const std::vector<prep::SourceImage>& images_;
  std::vector<pack::Texture>& textures_;
  std::vector<std::string>& notes_;
  bool strict_;
  std::map<std::size_t, std::optional<Decoded>> decoded_;  // of the material that is converted
  std::map<std::string, std::int32_t> made_;               // by image and recipe
};

}  // namespace malus::bake
