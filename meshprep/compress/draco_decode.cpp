// Decoding of untrusted bytes: counts are checked before Draco runs, attributes before their values are allocated, and
// all values afterwards.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <string>

#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/draco_header.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

namespace {

constexpr const char* kExpected = "data as malus writes it; bake or prepare the mesh again";

bool isPlainFloat3(const draco::PointAttribute& attribute) {
  return attribute.num_components() == 3 && attribute.data_type() == draco::DT_FLOAT32;
}

// Returns true if the attributes are one float position and at most one float normal.
bool hasExpectedAttributes(const draco::PointCloud& cloud) {
  if (cloud.NumNamedAttributes(draco::GeometryAttribute::POSITION) != 1) return false;
  const int normals = cloud.NumNamedAttributes(draco::GeometryAttribute::NORMAL);
  if (normals > 1 || cloud.num_attributes() != 1 + normals) return false;
  for (int i = 0; i < cloud.num_attributes(); ++i)
    if (!isPlainFloat3(*cloud.attribute(i))) return false;
  return true;
}

// Decoder of Draco that checks the attributes' descriptions before it decodes their values: a few bytes can declare
// gigabytes.
template <class Base>
class CheckedDecoder : public Base {
 public:
  explicit CheckedDecoder(const Limits& limits) : limits_(limits) {}

 protected:
  bool DecodeConnectivity() override {
    return Base::DecodeConnectivity() && this->point_cloud()->num_points() == limits_.vertices &&
           this->mesh()->num_faces() == limits_.triangles;
  }
  bool DecodeAllAttributes() override {
    return hasExpectedAttributes(*this->point_cloud()) && Base::DecodeAllAttributes();
  }

 private:
  Limits limits_;
};

template <class Base>
void runDecoder(draco::DecoderBuffer& buffer, const Limits& limits, draco::Mesh& mesh, std::string_view where) {
  CheckedDecoder<Base> decoder(limits);
  const draco::DecoderOptions options;
  draco::Status status;
  try {
    status = decoder.Decode(options, &buffer, &mesh);
  } catch (const std::exception& failure) {  // std::bad_alloc and std::length_error, from corrupt sizes
    throw Error(where, fmt::format("Draco data is corrupt: {}", failure.what()), kExpected);
  }
  if (!status.ok()) throw Error(where, fmt::format("Draco data is corrupt: {}", status.error_msg_string()), kExpected);
}

// Returns the values of an attribute, one per vertex.
std::vector<glm::vec3> attributeValues(const draco::PointAttribute& attribute, std::uint32_t vertices,
                                       std::string_view what, std::string_view where) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  std::vector<glm::vec3> values(vertices);
  const std::size_t available = attribute.buffer() == nullptr ? 0 : attribute.buffer()->data_size() / sizeof(glm::vec3);
  // Copy at once if values are contiguous and in vertex order, as in files by encode().
  const bool plain = attribute.is_mapping_identity() && attribute.byte_stride() == sizeof(glm::vec3) &&
                     attribute.byte_offset() == 0 && attribute.size() >= vertices && available >= vertices;
  if (plain) {
    std::memcpy(values.data(), attribute.buffer()->data(), vertices * sizeof(glm::vec3));
  } else {
    for (std::uint32_t i = 0; i < vertices; ++i) {
      const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
      if (index.value() >= attribute.size() || index.value() >= available)
        throw Error(where, fmt::format("{} of vertex {} is missing", what, i), kExpected);
      attribute.GetValue(index, &values[i]);
    }
  }
  for (std::uint32_t i = 0; i < vertices; ++i)
    if (!std::isfinite(values[i].x) || !std::isfinite(values[i].y) || !std::isfinite(values[i].z))
      throw Error(where, fmt::format("{} of vertex {} is not finite", what, i), kExpected);
  return values;
}

}  // namespace

Limits declaredCounts(std::span<const std::byte> bytes, std::string_view where) {
  const DracoHeader header = parseHeader(bytes, where);
  return {header.vertices, header.triangles};
}

TriangleMesh decode(std::span<const std::byte> bytes, const Limits& limits, std::string_view where) {
  // Check the declared counts.
  const DracoHeader header = parseHeader(bytes, where);
  if (header.vertices != limits.vertices || header.triangles != limits.triangles)
    throw Error(where, "Draco data has unexpected counts",
                fmt::format("{} vertices and {} triangles", limits.vertices, limits.triangles),
                fmt::format("{} and {}", header.vertices, header.triangles));
  if (limits.triangles > kMaxTriangles || limits.vertices > kMaxTriangles || limits.vertices == 0)
    throw Error(where, "Draco data has unsupported counts",
                fmt::format("1 to {} vertices and triangles", kMaxTriangles),
                fmt::format("{} and {}", limits.vertices, limits.triangles));

  const std::uint64_t most = kMaxPerByte * bytes.size();
  if (limits.triangles > most || limits.vertices > most)
    throw Error(where, "Draco data is too small for its declared counts",
                fmt::format("at most {} vertices and triangles in {} bytes", most, bytes.size()),
                fmt::format("{} and {}", limits.vertices, limits.triangles));

  // Decode.
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Mesh mesh;
  if (header.method == Method::kSequential) {
    runDecoder<draco::MeshSequentialDecoder>(buffer, limits, mesh, where);
  } else {
    runDecoder<draco::MeshEdgebreakerDecoder>(buffer, limits, mesh, where);
  }
  if (mesh.num_points() != limits.vertices || mesh.num_faces() != limits.triangles)
    throw Error(where, "Draco data decodes to unexpected counts",
                fmt::format("{} vertices and {} triangles", limits.vertices, limits.triangles),
                fmt::format("{} and {}", mesh.num_points(), mesh.num_faces()));

  // Copy and check all values.
  TriangleMesh result;
  result.positions =
      attributeValues(*mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION), limits.vertices, "position", where);
  if (const auto* normals = mesh.GetNamedAttribute(draco::GeometryAttribute::NORMAL); normals != nullptr) {
    result.normals = attributeValues(*normals, limits.vertices, "normal", where);
    for (std::size_t i = 0; i < result.normals.size(); ++i) {
      const float length = glm::length(result.normals[i]);
      if (!(length > 0.5f && length < 2.0f))
        throw Error(where, fmt::format("normal of vertex {} has an invalid length", i), "1", fmt::format("{}", length));
      result.normals[i] /= length;
    }
  }
  result.triangles.resize(limits.triangles);
  for (std::uint32_t i = 0; i < limits.triangles; ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    result.triangles[i] = {face[0].value(), face[1].value(), face[2].value()};
    if (std::max({face[0].value(), face[1].value(), face[2].value()}) >= limits.vertices)
      throw Error(where, fmt::format("invalid vertex index in triangle {}", i),
                  fmt::format("an index below {}", limits.vertices));
  }
  return result;
}

}  // namespace malus::compress
