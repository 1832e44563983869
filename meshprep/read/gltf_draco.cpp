#include "meshprep/read/gltf_draco.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/compress/draco_header.h"

namespace malus::prep {

namespace {

constexpr const char* kExpected = "an undamaged file; export it again, without Draco compression if that fails too";

constexpr int kMaxAttributes = 16;
constexpr int kMaxVertexBytes = 128;

// Decoder of Draco that fails unless its counts equal those of the accessors, and checks the attributes' descriptions
// before it decodes their values.
template <class Base>
class CheckedDecoder : public Base {
 public:
  explicit CheckedDecoder(const GltfDracoCounts& counts) : counts_(counts) {}
  const std::string& mismatch() const { return mismatch_; }

 protected:
  bool DecodeConnectivity() override {
    if (!Base::DecodeConnectivity()) return false;
    const std::size_t points = this->point_cloud()->num_points(), faces = this->mesh()->num_faces();
    if (points == counts_.vertices && faces == counts_.triangles) return true;
    mismatch_ = fmt::format("{} vertices and {} triangles", points, faces);
    return false;
  }
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    int vertexBytes = 0;
    for (int i = 0; i < cloud.num_attributes(); ++i)
      vertexBytes += cloud.attribute(i)->num_components() * draco::DataTypeLength(cloud.attribute(i)->data_type());
    if (cloud.num_attributes() <= kMaxAttributes && vertexBytes <= kMaxVertexBytes) return Base::DecodeAllAttributes();
    mismatch_ = fmt::format("{} attributes of {} bytes per vertex", cloud.num_attributes(), vertexBytes);
    return false;
  }

 private:
  GltfDracoCounts counts_;
  std::string mismatch_;
};

std::string describeExpected(const GltfDracoCounts& counts) {
  return fmt::format("{} vertices and {} triangles, in at most {} attributes of {} bytes per vertex", counts.vertices,
                     counts.triangles, kMaxAttributes, kMaxVertexBytes);
}

template <class Base>
void run(std::span<const std::byte> bytes, const GltfDracoCounts& counts, draco::Mesh& mesh,
         const std::string& location) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  CheckedDecoder<Base> decoder(counts);
  draco::Status status;
  try {
    status = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh);
  } catch (const std::exception& failure) {  // std::bad_alloc and std::length_error, from corrupt sizes
    throw Error(location, fmt::format("Draco data is corrupt: {}", failure.what()), kExpected);
  }
  if (status.ok()) return;
  if (!decoder.mismatch().empty())
    throw Error(location, "Draco data has unexpected counts", describeExpected(counts), decoder.mismatch());
  throw Error(location, fmt::format("Draco data is corrupt: {}", status.error_msg_string()), kExpected);
}

// Returns the values of the attribute with this id, one per vertex. Vector: of the floats of one value.
template <class Vector>
std::vector<Vector> attributeValues(const draco::Mesh& mesh, std::uint32_t id, std::string_view what,
                                    const std::string& location) {
  constexpr int kComponents = Vector::length();
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (attribute == nullptr || attribute->num_components() != kComponents ||
      attribute->data_type() != draco::DT_FLOAT32 || attribute->buffer() == nullptr)
    throw Error(location, fmt::format("missing {} attribute in the Draco data", what),
                fmt::format("an attribute of {} floats", kComponents), fmt::format("attribute {}", id));
  std::vector<Vector> values;
  values.reserve(mesh.num_points());
  const std::size_t available = attribute->buffer()->data_size() / sizeof(Vector);
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(i));
    if (index.value() >= attribute->size() || index.value() >= available)
      throw Error(location, fmt::format("the {} of vertex {} is missing", what, i), kExpected);
    Vector value;
    attribute->GetValue(index, &value);
    for (int c = 0; c < kComponents; ++c)
      if (!std::isfinite(value[c]))
        throw Error(location, fmt::format("the {} of vertex {} is not finite", what, i), kExpected);
    values.push_back(value);
  }
  return values;
}

// Reads the attributes of textures that have an id.
VertexTextures readTextures(const draco::Mesh& mesh, const GltfDracoCounts& counts, const std::string& location) {
  VertexTextures textures;
  for (std::size_t set = 0; set < counts.coordinateIds.size(); ++set) {
    if (!counts.coordinateIds[set]) continue;
    textures.coordinates[set] =
        attributeValues<glm::vec2>(mesh, *counts.coordinateIds[set], "texture coordinate", location);
    for (const glm::vec2& uv : textures.coordinates[set])
      if (!isAcceptedCoordinate(static_cast<double>(uv.x)) || !isAcceptedCoordinate(static_cast<double>(uv.y)))
        throw Error(location, "texture coordinate of the Draco data is out of range",
                    fmt::format("-{0:g} to {0:g}", kMaxTextureCoordinate), fmt::format("({}, {})", uv.x, uv.y));
  }
  if (counts.tangentId) textures.tangents = attributeValues<glm::vec4>(mesh, *counts.tangentId, "tangent", location);
  for (glm::vec4& t : textures.tangents) t.w = t.w < 0 ? -1.0f : 1.0f;  // quantized
  return textures;
}

}  // namespace

GltfDracoMesh decodeGltfDraco(std::span<const std::byte> bytes, const GltfDracoCounts& counts,
                              const std::string& location) {
  // Check the declared counts. Edgebreaker declares fewer vertices if it splits them at seams.
  const compress::DracoHeader header = compress::parseHeader(bytes, location, kMaxAttributes);
  const bool sequential = header.method == compress::Method::kSequential;
  if (header.triangles != counts.triangles || header.vertices > counts.vertices ||
      (sequential && header.vertices != counts.vertices))
    throw Error(location, "Draco data has unexpected counts", describeExpected(counts),
                fmt::format("{} and {}", header.vertices, header.triangles));

  // Decode.
  draco::Mesh mesh;
  if (sequential) {
    run<draco::MeshSequentialDecoder>(bytes, counts, mesh, location);
  } else {
    run<draco::MeshEdgebreakerDecoder>(bytes, counts, mesh, location);
  }

  // Copy and check all values.
  GltfDracoMesh result;
  for (const glm::vec3& p : attributeValues<glm::vec3>(mesh, counts.positionId, "position", location))
    result.positions.emplace_back(p);
  if (counts.normalId) result.normals = attributeValues<glm::vec3>(mesh, *counts.normalId, "normal", location);
  result.textures = readTextures(mesh, counts, location);
  result.corners.reserve(3 * counts.triangles);
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i))) {
      if (corner.value() >= counts.vertices)
        throw Error(location, fmt::format("invalid vertex index in triangle {} of the Draco data", i),
                    fmt::format("an index below {}", counts.vertices), fmt::to_string(corner.value()));
      result.corners.push_back(corner.value());
    }
  return result;
}

}  // namespace malus::prep
