// The geometry of a scene pack: sections MESH, GEOM and SMAP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/reader.h"

namespace malus::pack {

// table: contents of MESH, of this version; geometry: those of GEOM, at geometryOffset in the file. Fills meshes,
// compression and geometry of the pack, whose materials must have been read. Throws Error.
void readMeshes(ByteReader table, std::uint32_t version, std::span<const std::byte> geometry,
                std::uint64_t geometryOffset, std::string_view where, Pack& pack);

// Fills the meshes' maps to their sources. Throws Error.
void readSourceMap(ByteReader reader, std::vector<Mesh>& meshes);

}  // namespace malus::pack
