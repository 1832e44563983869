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
//   normal               normal map
//   alpha                of a mask: cut out below its cutoff. Of a blended material: cut out below 0.5 if at most a
//   tenth
//                        of the texels is between 0.1 and 0.9 (kSharpAlpha); otherwise thin glass has the internal
//                        transmittance 1 - a (1 - colour)
#pragma once

#include <cstddef>
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
  bool isMixed(const prep::SourceMaterial& factors);
  bool hasSharpAlpha(const prep::SourceMaterial& factors);
  template <class Texel>
  pack::MeshMap add(std::size_t image, const prep::SourcePlacement& place, const std::string& recipe, Texel texel);
  void addColour(const prep::SourceMaterial& factors, pack::Material& material);
  void addRoughness(const prep::SourceMaterial& factors, pack::Material& material);
  void addMetal(const prep::SourceMaterial& factors, pack::Material& material);
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
