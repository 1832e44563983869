// Decoding of a primitive with KHR_draco_mesh_compression. The declared counts must equal those of the accessors before
// Draco allocates memory (61 bytes can declare 20 GB). Attributes without an id are decoded, because Draco cannot skip
// them, and dropped. Source: KHR_draco_mesh_compression; Draco bitstream specification 2.2,
// https://google.github.io/draco/spec/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/read/vertex_textures.h"

namespace malus::prep {

// Counts of the accessors, and ids of the attributes in the Draco data.
struct GltfDracoCounts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::uint32_t positionId = 0;
  std::optional<std::uint32_t> normalId, tangentId;
  std::array<std::optional<std::uint32_t>, 2> coordinateIds;  // texture coordinates
};

struct GltfDracoMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;      // one per position, or empty
  std::vector<std::uint32_t> corners;  // three per triangle
  VertexTextures textures;
};

// location: the primitive, for messages. Throws Error: not a Draco 2.2 mesh, unexpected counts, an attribute that is
// missing or not of floats, texture coordinates out of range, more than 16 attributes or 128 bytes per vertex, values
// that are not finite, corrupt data.
GltfDracoMesh decodeGltfDraco(std::span<const std::byte> bytes, const GltfDracoCounts& counts,
                              const std::string& location);

}  // namespace malus::prep
