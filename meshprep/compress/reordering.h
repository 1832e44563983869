// Proof that one mesh is another in a different order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// For each triangle of `decoded`, the triangle of `source` that it is, each named once; nothing where they are not the
// same. vertices: for each vertex of `decoded`, the vertex of `source` that it is said to be: it must be a permutation,
// under which positions and normals are equal bit by bit and the triangles the same with the same sides.
std::optional<std::vector<std::uint32_t>> sourceTriangles(const TriangleMesh& source, const TriangleMesh& decoded,
                                                          std::span<const std::uint32_t> vertices);

}  // namespace malus::compress
