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

constexpr int kMaxAttributes = 16;
constexpr int kMaxVertexBytes = 128;

// Draco's decoder, stopped where its counts are not those of the accessors, and between the description of the
// attributes and their values.
template <class Base>
class Guarded : public Base {
 public:
  explicit Guarded(const GltfDracoClaims& claims) : claims_(claims) {}
  const std::string& refusal() const { return refusal_; }

 protected:
  bool DecodeConnectivity() override {
    if (!Base::DecodeConnectivity()) return false;
    const std::size_t points = this->point_cloud()->num_points(), faces = this->mesh()->num_faces();
    if (points == claims_.vertices && faces == claims_.triangles) return true;
    refusal_ = fmt::format("{} vertices and {} triangles", points, faces);
    return false;
  }
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    int vertexBytes = 0;
    for (int i = 0; i < cloud.num_attributes(); ++i)
      vertexBytes += cloud.attribute(i)->num_components() * draco::DataTypeLength(cloud.attribute(i)->data_type());
    if (cloud.num_attributes() <= kMaxAttributes && vertexBytes <= kMaxVertexBytes) return Base::DecodeAllAttributes();
    refusal_ = fmt::format("{} attributes of {} bytes a vertex", cloud.num_attributes(), vertexBytes);
    return false;
  }

 private:
  GltfDracoClaims claims_;
  std::string refusal_;
};

std::string expectedOf(const GltfDracoClaims& claims) {
  return fmt::format("{} vertices and {} triangles, in at most {} attributes of {} bytes a vertex", claims.vertices,
                     claims.triangles, kMaxAttributes, kMaxVertexBytes);
}

template <class Base>
void run(std::span<const std::byte> bytes, const GltfDracoClaims& claims, draco::Mesh& mesh, const std::string& place) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Guarded<Base> decoder(claims);
  draco::Status status;
  try {
    status = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh);
  } catch (const std::exception& failure) {  // std::bad_alloc and std::length_error from damaged sizes
    throw Error(place, "Draco data is damaged", "", failure.what());
  }
  if (status.ok()) return;
  if (!decoder.refusal().empty())
    throw Error(place, "Draco data of another mesh", expectedOf(claims), decoder.refusal());
  throw Error(place, "Draco data is damaged", "", status.error_msg_string());
}

// The values of the attribute with this id, one a vertex.
std::vector<glm::vec3> valuesOf(const draco::Mesh& mesh, std::uint32_t id, std::string_view what,
                                const std::string& place) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (attribute == nullptr || attribute->num_components() != 3 || attribute->data_type() != draco::DT_FLOAT32 ||
      attribute->buffer() == nullptr)
    throw Error(place, fmt::format("Draco data has no {} of that id", what), "an attribute of three floats",
                fmt::format("attribute {}", id));
  std::vector<glm::vec3> values;
  values.reserve(mesh.num_points());
  const std::size_t available = attribute->buffer()->data_size() / sizeof(glm::vec3);
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(i));
    if (index.value() >= attribute->size() || index.value() >= available)
      throw Error(place, fmt::format("the {} of vertex {} is missing", what, i));
    std::array<float, 3> v{};
    attribute->GetValue(index, v.data());
    if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2]))
      throw Error(place, fmt::format("the {} of vertex {} is not finite", what, i));
    values.emplace_back(v[0], v[1], v[2]);
  }
  return values;
}

}  // namespace

GltfDracoMesh decodeGltfDraco(std::span<const std::byte> bytes, const GltfDracoClaims& claims,
                              const std::string& place) {
  // Step 1: what the data claims. An edgebreaker's vertices are split at seams, so they may be fewer, never more.
  const compress::DracoHeader header = compress::parseHeader(bytes, place, kMaxAttributes);
  const bool sequential = header.method == compress::Method::kSequential;
  if (header.triangles != claims.triangles || header.vertices > claims.vertices ||
      (sequential && header.vertices != claims.vertices))
    throw Error(place, "Draco data of another mesh", expectedOf(claims),
                fmt::format("{} and {}", header.vertices, header.triangles));

  // Step 2: decode.
  draco::Mesh mesh;
  if (sequential) {
    run<draco::MeshSequentialDecoder>(bytes, claims, mesh, place);
  } else {
    run<draco::MeshEdgebreakerDecoder>(bytes, claims, mesh, place);
  }

  // Step 3: copy out, checking every value.
  GltfDracoMesh result;
  for (const glm::vec3& p : valuesOf(mesh, claims.positionId, "position", place)) result.positions.emplace_back(p);
  if (claims.normalId) result.normals = valuesOf(mesh, *claims.normalId, "normal", place);
  result.corners.reserve(3 * claims.triangles);
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i))) {
      if (corner.value() >= claims.vertices)
        throw Error(place, fmt::format("triangle {} of the Draco data names a vertex that is not there", i),
                    fmt::format("below {}", claims.vertices), fmt::to_string(corner.value()));
      result.corners.push_back(corner.value());
    }
  return result;
}

}  // namespace malus::prep
