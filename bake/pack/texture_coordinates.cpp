#include "bake/pack/texture_coordinates.h"

#include <algorithm>

#include "bake/pack/field_io.h"
#include "bake/pack/record_fields.h"

namespace malus::pack {

double textureTexels(const Scene& scene, const Mesh& mesh) {
  std::uint32_t side = 0;
  if (mesh.material < scene.materials.size()) {
    const Maps& maps = scene.materials[mesh.material].maps;
    for (const std::int32_t map : {maps.albedo, maps.eta, maps.k}) {
      if (map < 0 || static_cast<std::size_t>(map) >= scene.textures.size()) continue;
      const Texture& texture = scene.textures[static_cast<std::size_t>(map)];
      side = std::max({side, texture.width, texture.height});
    }
  }
  return side > 0 ? side : compress::kDefaultTexels;
}

compress::TextureView textureView(const Mesh& mesh) {
  return {{mesh.textureCoordinates[0], mesh.textureCoordinates[1]}, mesh.tangents};
}

std::vector<std::byte> textureBytes(const std::vector<TextureEncoding>& textures) {
  const bool any =
      std::any_of(textures.begin(), textures.end(), [](const TextureEncoding& t) { return t.grids.any(); });
  ByteWriter w;
  if (!any) return {};
  w.u32(static_cast<std::uint32_t>(textures.size()));
  for (const TextureEncoding& texture : textures) {
    const TextureEntry entry{texture, static_cast<std::uint32_t>(texture.grids.tangentBits)};
    visitTextureEntry(FieldWriter(w), entry);
  }
  return w.take();
}

std::vector<TextureEncoding> readTextureEncodings(ByteReader r, std::string_view where) {
  FieldSizes sizes;
  const TextureEntry any{};
  visitTextureEntry(sizes, any);
  std::vector<TextureEncoding> textures(r.count(sizes.bytes(), kMaxMeshes, "number of entries"));
  for (TextureEncoding& texture : textures) {
    TextureEntry entry;
    visitTextureEntry(FieldReader(r), entry);
    entry.grids.tangentBits = static_cast<int>(entry.tangentBits);
    compress::requireValid(entry.grids, where);
    texture = entry;
  }
  r.end();
  return textures;
}

}  // namespace malus::pack
