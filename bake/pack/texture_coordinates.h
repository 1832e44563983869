// Section TCRD: texture coordinates and tangents of the meshes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/scene.h"

namespace malus::pack {

// Appends the attributes of a mesh whose vertices the pack stores in another order: order[i] is the mesh's vertex of
// the pack's vertex i.
void writeTextureAttributes(ByteWriter& writer, const Mesh& mesh, std::span<const std::uint32_t> order);

// Fills the attributes of the meshes. Throws Error: counts that differ from those of the meshes, values that are not
// finite or out of range.
void readTextureAttributes(ByteReader reader, std::vector<Mesh>& meshes);

}  // namespace malus::pack
