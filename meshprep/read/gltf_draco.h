// One primitive of KHR_draco_mesh_compression, decoded under guard: what the bytes claim must be what the accessors
// say before Draco allocates by it (61 bytes can claim 20 GB). Attributes that nobody here needs (texture
// coordinates, tangents, colours) may be there; they are decoded, because Draco cannot pass over them, and dropped.
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

// What the file's accessors say about the primitive, and the ids of the attributes in the Draco data.
struct GltfDracoClaims {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::uint32_t positionId = 0;
  std::optional<std::uint32_t> normalId;
};

struct GltfDracoMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;      // one a position, or none
  std::vector<std::uint32_t> corners;  // three a triangle
};

// place: the primitive, for messages. Throws Error: no Draco 2.2 mesh, other counts, an attribute that is not there
// or not three floats, more than 16 attributes or 128 bytes a vertex, numbers that are not finite, damaged data.
GltfDracoMesh decodeGltfDraco(std::span<const std::byte> bytes, const GltfDracoClaims& claims,
                              const std::string& place);

}  // namespace malus::prep
