// Draco meshes and their encoding, without verification.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <draco/mesh/mesh.h>
#include <glm/vec3.hpp>

#include "meshprep/compress/draco_header.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Integers of more bits than kPlainBits are split, because Draco counts symbols in a table of their largest value: the
// position attribute has the quotient by 2^kLowBits, a generic one has the rest.
inline constexpr int kPlainBits = 20;
inline constexpr int kLowBits = 10;

// A set of texture coordinates is an attribute of two integers, or of four if they are split: the quotients by
// 2^kLowBits, then the rests. Tangents are a generic attribute of two integers.
inline constexpr int kTangentComponents = 2;

// Returns the input of Draco: one point per vertex of the mesh in its order, with the integers of the rounded positions
// on the grid, its normals and the integers of the textures. The positions of the mesh are not read. Throws
// Error if a position is not on the grid.
std::unique_ptr<draco::Mesh> makeDracoMesh(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Grid& grid,
                                           const RoundedTextures& textures);

struct DracoBytes {
  std::vector<std::byte> bytes;

  // Edgebreaker: the vertex of the mesh whose values are the k-th ones of each attribute in the file.
  std::vector<std::uint32_t> vertexOfValue;
};

// Encodes a mesh of makeDracoMesh(). Returns nothing if Draco fails.
std::optional<DracoBytes> writeDraco(Method method, const draco::Mesh& mesh, int normalBits);

// Returns a lower bound of the bytes that sequential encoding takes: those of its indices, which it does not compress.
std::size_t leastSequentialBytes(const draco::Mesh& mesh);

}  // namespace malus::compress
