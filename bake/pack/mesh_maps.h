// Maps of materials by texture coordinates: section MAPS of the pack.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/field.h"
#include "bake/pack/format.h"
#include "bake/pack/scene.h"

namespace malus::pack {

// Bounds of the values that a map replaces, and the kinds of material that may have it.
struct MapRule {
  std::string_view name;
  double low = 0, high = 1;
  KindSet kinds = kEveryKind;
};

// Calls visit(rule, map of each of maps...) for every map, in the order of the bytes.
template <class Visitor, class... Maps>
void visitMeshMaps(Visitor&& visit, Maps&... m) {
  constexpr KindSet kIndexed = kindsWhere(canHaveIndexMap), kMetals = kindsWhere(isConductor);
  visit(MapRule{.name = "albedo", .kinds = kindsWhere(canBeDiffuse)}, m.albedo...);
  visit(MapRule{.name = "eta", .high = kMaxEta, .kinds = kIndexed}, m.eta...);
  visit(MapRule{.name = "k", .low = kMinEta, .high = kMaxEta, .kinds = kMetals}, m.k...);
  visit(MapRule{.name = "reflectance", .kinds = kMetals}, m.reflectance...);
  visit(MapRule{.name = "metallic", .kinds = kMetals}, m.metallic...);
  visit(MapRule{.name = "roughness", .kinds = kindsWhere(canBeRough)}, m.roughness...);
  visit(MapRule{.name = "radiance", .high = kMaxLight, .kinds = kindsWhere(isEmitter) | kindsWhere(canBeDiffuse)},
        m.radiance...);
  visit(MapRule{.name = "transmittance", .kinds = only(MaterialKind::thinGlass) | only(MaterialKind::glass)},
        m.transmittance...);
  visit(MapRule{.name = "normal"}, m.normal...);
  visit(MapRule{.name = "coverage"}, m.coverage...);
}

// The fields of one map.
template <class Visitor, class... Maps>
void visitMeshMap(Visitor&& visit, Maps&... m) {
  visit(Field{.name = "texture", .text = "1 + index into TEXR; 0: none", .isTexture = true}, m.texture...);
  visit(Field{.name = "set", .high = 1, .text = "set of the texture coordinates (s, t) of the meshes"}, m.set...);
  visit(Field{.name = "wrapU", .high = 2, .text = "beyond the edges: 0 repeated, 1 clamped, 2 mirrored"}, m.wrapU...);
  visit(Field{.name = "wrapV", .high = 2, .text = "the same"}, m.wrapV...);
  visit(Field{.name = "u",
              .low = -kMaxTextureCoordinate,
              .high = kMaxTextureCoordinate,
              .text = "the texture is read at dot(u, (s, t, 1)), from the left"},
        m.u...);
  visit(Field{.name = "v",
              .low = -kMaxTextureCoordinate,
              .high = kMaxTextureCoordinate,
              .text = "and at dot(v, (s, t, 1)), from the top"},
        m.v...);
}

// The fields of a material after its maps.
template <class Visitor, class... Maps>
void visitMeshMapFactors(Visitor&& visit, Maps&... m) {
  visit(
      Field{.name = "normalScale", .low = -100, .high = 100, .text = "factor of the first two components of a normal"},
      m.normalScale...);
  visit(Field{.name = "cutoff", .high = 1e6, .text = "coverage below which there is no surface"}, m.cutoff...);
}

bool hasMeshMaps(const std::vector<Material>& materials);

void writeMeshMaps(ByteWriter& writer, const std::vector<Material>& materials);

// Fills the maps of the materials. Throws Error: a number out of range, a texture out of the bounds of what it
// replaces, or a map that the kind of the material cannot have.
void readMeshMaps(ByteReader reader, const std::vector<Texture>& textures, std::vector<Material>& materials);

}  // namespace malus::pack
