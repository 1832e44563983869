// Draco encoding without verification, and the vertex order of edgebreaker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

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

// positions: integers of the grid, one per vertex of the mesh, whose own positions are not read. Returns nothing if
// Draco fails. Mesh and settings must be valid inputs of encode().
std::optional<std::vector<std::byte>> encodeDraco(Method method, const MeshView& mesh,
                                                  std::span<const glm::ivec3> positions, int normalBits,
                                                  const RoundedTextures& textures);

// Returns true if integers of the grid are split.
bool areSplit(std::span<const glm::ivec3> positions);

// Returns the source vertex of each vertex that edgebreaker decodes, or nothing if Draco fails. The mesh is encoded
// again with vertex numbers in place of positions, on which the order does not depend. The caller must verify the
// result.
std::optional<std::vector<std::uint32_t>> edgebreakerOrder(const MeshView& mesh, std::span<const glm::ivec3> positions,
                                                           const RoundedTextures& textures);

}  // namespace malus::compress
