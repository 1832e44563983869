// Draco encoding without verification, and the vertex order of edgebreaker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshprep/compress/draco_header.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// positions: integers of the grid, one per vertex of the mesh, whose own positions are not read. Returns nothing if
// Draco fails. Mesh and settings must be valid inputs of encode().
std::optional<std::vector<std::byte>> encodeDraco(Method method, const MeshView& mesh,
                                                  std::span<const glm::ivec3> positions, int normalBits);

// Returns the source vertex of each vertex that edgebreaker decodes, or nothing if Draco fails. The mesh is encoded
// again with vertex numbers in place of positions, on which the order does not depend. The caller must verify the
// result.
std::optional<std::vector<std::uint32_t>> edgebreakerOrder(const MeshView& mesh);

}  // namespace malus::compress
