// Permutations of the vertices and triangles of a mesh in another, of the kind that Draco decodes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <draco/mesh/mesh.h>

namespace malus::compress {

// Returns the faces of a mesh, which must outlive them.
std::span<const draco::Mesh::Face> faces(const draco::Mesh& mesh);

// Returns true if every number below numbers.size() occurs once.
bool isPermutation(std::span<const std::uint32_t> numbers);

// Returns the triangle of `source` for each triangle of `decoded`, a permutation, or nothing if the triangles differ:
// equal ones have equal corners and orientation. vertices: the vertex of `source` for each vertex of `decoded`, a
// permutation.
std::optional<std::vector<std::uint32_t>> matchTriangles(std::span<const draco::Mesh::Face> source,
                                                         std::span<const draco::Mesh::Face> decoded,
                                                         std::span<const std::uint32_t> vertices);

// Returns true if vertex i of `decoded` has the values of vertex vertices[i] of `source` for each i: equal integers,
// and the normals that Draco decodes from octahedral coordinates of so many bits. The attributes must have the same
// order.
bool haveEqualValues(const draco::Mesh& source, const draco::Mesh& decoded, std::span<const std::uint32_t> vertices,
                     int normalBits);

}  // namespace malus::compress
