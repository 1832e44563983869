// Section TCRD: what the integers of texture coordinates and tangents in GEOM mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/encodings.h"
#include "bake/pack/scene.h"
#include "meshprep/compress/texture_rounding.h"

namespace malus::pack {

// Longer side in texels of the largest texture of a mesh's material, or compress::kDefaultTexels without any.
double textureTexels(const Scene& scene, const Mesh& mesh);

// Attributes of a mesh, which must outlive the view.
compress::TextureView textureView(const Mesh& mesh);

// One entry per mesh. Empty unless one of them has texture attributes.
std::vector<std::byte> textureBytes(const std::vector<TextureEncoding>& textures);

// Throws Error: a number of entries that is not that of the meshes, numbers out of range, invalid grids. Leaves the
// list empty without a section.
std::vector<TextureEncoding> readTextureEncodings(ByteReader reader, std::string_view where);

}  // namespace malus::pack
