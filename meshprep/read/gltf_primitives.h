// Reading of the primitives of a glTF file, within the limits of the file (read_gltf.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_accessor.h"
#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_left_out.h"
#include "meshprep/read/gltf_pose.h"
#include "meshprep/read/polygons.h"
#include "meshprep/read/source_scene.h"
#include "meshprep/read/vertex_textures.h"

namespace malus::prep {

class GltfPrimitiveReader {
 public:
  // fileBytes: size of the file without its buffers. where: the file, for messages. The references must outlive the
  // object.
  GltfPrimitiveReader(const gltf::Document& document, GltfBuffers& buffers, std::size_t fileBytes, std::string where,
                      GltfLeftOut& leftOut);

  // Returns the triangles of a primitive in its pose; empty for points and lines. `location` is for messages. Leaves
  // out a triangle with an index out of range or a position that is not finite, the corners at the end of a list that
  // are no triangle, and normals, tangents and texture coordinates that are not finite or out of range (which become
  // zero). textures: attributes of textures that are read. Throws Error: an unknown mode, no positions,
  // an accessor that is missing, invalid or of the wrong type, no valid triangle. Throws GltfLimitError.
  Polygons read(const gltf::Primitive& primitive, const TextureNeeds& textures, const GltfPose& pose,
                const std::string& location);

  // Totals so far.
  std::size_t triangleCount() const { return triangles_; }
  std::size_t vertexCount() const { return vertices_; }

 private:
  struct Vectors {
    GltfAccessor accessor;
    bool isFinite = true;  // all of them
  };

  std::size_t bytes() const { return fileBytes_ + buffers_.bytesRead(); }
  void addTriangles(std::size_t count, std::size_t backed, const std::string& location);
  void addVertices(std::size_t count, const std::string& location);
  std::size_t declaredCount(std::size_t index) const;
  const Vectors& vectors(std::size_t index);
  std::vector<std::uint32_t> readTriangles(const gltf::Primitive& primitive, const Vectors& positions,
                                           const std::string& location);
  std::vector<std::uint32_t> readCorners(const GltfAccessor& accessor, std::size_t count, std::size_t vertices,
                                         std::optional<Error>& first) const;
  void dropInvalid(std::vector<std::uint32_t>& corners, const Vectors& positions, std::optional<Error> first,
                   const std::string& location);
  void readVertices(const std::vector<std::uint32_t>& kept, const Vectors& positions, const Vectors* normals,
                    Polygons& polygons);
  void readTextures(const gltf::Primitive& primitive, const TextureNeeds& needs, std::size_t vertices,
                    const std::vector<std::uint32_t>& kept, VertexTextures& textures);
  Polygons readDraco(const gltf::Primitive& primitive, const TextureNeeds& textures, const GltfPose& pose,
                     const std::string& location);

  const gltf::Document& document_;
  GltfBuffers& buffers_;
  std::size_t fileBytes_;
  std::string where_;
  GltfLeftOut& leftOut_;
  std::map<std::size_t, std::size_t> users_;  // primitives per accessor of positions
  std::map<std::size_t, Vectors> vectors_;    // checked accessors
  std::size_t triangles_ = 0, vertices_ = 0;
};

}  // namespace malus::prep
