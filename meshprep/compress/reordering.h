// Permutation of the vertices and triangles of a mesh in another.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Returns the vertex of `source` for each vertex of `decoded` by equal positions, normals and attributes of textures,
// or nothing if two vertices of `source` have equal values, or a vertex of `decoded` has no equal one.
std::optional<std::vector<std::uint32_t>> matchVertices(const TriangleMesh& source, const TriangleMesh& decoded);

// Returns the triangle of `source` for each triangle of `decoded`, a permutation, or nothing if the meshes differ.
// vertices: the assumed vertex of `source` for each vertex of `decoded`. The meshes are equal if this is a permutation
// under which all values are equal and triangles have equal corners and orientation.
std::optional<std::vector<std::uint32_t>> sourceTriangles(const TriangleMesh& source, const TriangleMesh& decoded,
                                                          std::span<const std::uint32_t> vertices);

}  // namespace malus::compress
