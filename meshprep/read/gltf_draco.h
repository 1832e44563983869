// Decoding of a primitive with KHR_draco_mesh_compression. The declared counts must equal those of the accessors before
// Draco allocates memory (61 bytes can declare 20 GB). Other attributes (texture coordinates, tangents, colours) are
// decoded, because Draco cannot skip them, and dropped.
// Source: KHR_draco_mesh_compression; Draco bitstream specification 2.2, https://google.github.io/draco/spec/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

// Counts of the accessors, and ids of the attributes in the Draco data.
struct GltfDracoCounts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::uint32_t positionId = 0;
  std::optional<std::uint32_t> normalId;
};

struct GltfDracoMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;      // one per position, or empty
  std::vector<std::uint32_t> corners;  // three per triangle
};

// location: the primitive, for messages. Throws Error: not a Draco 2.2 mesh, unexpected counts, an attribute that is
// missing or not three floats, more than 16 attributes or 128 bytes per vertex, values that are not finite, corrupt
// data.
GltfDracoMesh decodeGltfDraco(std::span<const std::byte> bytes, const GltfDracoCounts& counts,
                              const std::string& location);

}  // namespace malus::prep
