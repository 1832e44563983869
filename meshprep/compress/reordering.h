// Verification that a mesh is a permutation of another.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Returns the triangle of `source` for each triangle of `decoded`, a permutation, or nothing if the meshes differ.
// vertices: the assumed vertex of `source` for each vertex of `decoded`. The meshes are equal if this is a permutation
// under which positions and normals have equal values and triangles have equal corners and orientation.
std::optional<std::vector<std::uint32_t>> sourceTriangles(const TriangleMesh& source, const TriangleMesh& decoded,
                                                          std::span<const std::uint32_t> vertices);

}  // namespace malus::compress
