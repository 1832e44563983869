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
#include "meshprep/compress/draco_write.h"

namespace malus::compress {

namespace {

constexpr const char* kExpected = "data as malus writes it; bake or prepare the mesh again";

// Type of the position attribute: integers of a grid, or floats in packs of format version 1.
bool hasType(const draco::PointAttribute& attribute, draco::DataType type) {
  return attribute.num_components() == 3 && attribute.data_type() == type;
}

// Returns true if the attributes are one position of the given type, at most one float normal, and for integers at most
// one generic attribute of integers, the low bits of the positions.
bool hasExpectedAttributes(const draco::PointCloud& cloud, draco::DataType positionType) {
  if (cloud.NumNamedAttributes(draco::GeometryAttribute::POSITION) != 1) return false;
  const int normals = cloud.NumNamedAttributes(draco::GeometryAttribute::NORMAL);
  const int lows = cloud.NumNamedAttributes(draco::GeometryAttribute::GENERIC);
  if (normals > 1 || lows > (positionType == draco::DT_INT32 ? 1 : 0) || cloud.num_attributes() != 1 + normals + lows)
    return false;
  for (int i = 0; i < cloud.num_attributes(); ++i) {
    const draco::PointAttribute& attribute = *cloud.attribute(i);
    const bool isNormal = attribute.attribute_type() == draco::GeometryAttribute::NORMAL;
    if (!hasType(attribute, isNormal ? draco::DT_FLOAT32 : positionType)) return false;
  }
  return true;
}

// Decoder of Draco that checks the attributes' descriptions before it decodes their values: a few bytes can declare
// gigabytes.
template <class Base>
class CheckedDecoder : public Base {
 public:
  CheckedDecoder(const Limits& limits, draco::DataType positionType) : limits_(limits), positionType_(positionType) {}

 protected:
  bool DecodeConnectivity() override {
    return Base::DecodeConnectivity() && this->point_cloud()->num_points() == limits_.vertices &&
           this->mesh()->num_faces() == limits_.triangles;
  }
  bool DecodeAllAttributes() override {
    return hasExpectedAttributes(*this->point_cloud(), positionType_) && Base::DecodeAllAttributes();
  }

 private:
  Limits limits_;
  draco::DataType positionType_;
};

template <class Base>
void runDecoder(draco::DecoderBuffer& buffer, const Limits& limits, draco::DataType positionType, draco::Mesh& mesh,
                std::string_view where) {
  CheckedDecoder<Base> decoder(limits, positionType);
  const draco::DecoderOptions options;
  draco::Status status;
  try {
    status = decoder.Decode(options, &buffer, &mesh);
  } catch (const std::exception& failure) {  // std::bad_alloc and std::length_error, from corrupt sizes
    throw Error(where, fmt::format("Draco data is corrupt: {}", failure.what()), kExpected);
  }
  if (!status.ok()) throw Error(where, fmt::format("Draco data is corrupt: {}", status.error_msg_string()), kExpected);
}

// Returns the values of an attribute, one per vertex. Vector: three values of the attribute's type.
template <class Vector>
std::vector<Vector> attributeValues(const draco::PointAttribute& attribute, std::uint32_t vertices,
                                    std::string_view what, std::string_view where) {
  static_assert(sizeof(Vector) == 12);
  std::vector<Vector> values(vertices);
  const std::size_t available = attribute.buffer() == nullptr ? 0 : attribute.buffer()->data_size() / sizeof(Vector);
  // Copy at once if values are contiguous and in vertex order, as in files by encode().
  const bool plain = attribute.is_mapping_identity() && attribute.byte_stride() == sizeof(Vector) &&
                     attribute.byte_offset() == 0 && attribute.size() >= vertices && available >= vertices;
  if (plain) {
    std::memcpy(values.data(), attribute.buffer()->data(), vertices * sizeof(Vector));
  } else {
    for (std::uint32_t i = 0; i < vertices; ++i) {
      const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
      if (index.value() >= attribute.size() || index.value() >= available)
        throw Error(where, fmt::format("{} of vertex {} is missing", what, i), kExpected);
      attribute.GetValue(index, &values[i]);
    }
  }
  return values;
}

std::vector<glm::vec3> finiteValues(const draco::PointAttribute& attribute, std::uint32_t vertices,
                                    std::string_view what, std::string_view where) {
  std::vector<glm::vec3> values = attributeValues<glm::vec3>(attribute, vertices, what, where);
  for (std::uint32_t i = 0; i < vertices; ++i)
    if (!std::isfinite(values[i].x) || !std::isfinite(values[i].y) || !std::isfinite(values[i].z))
      throw Error(where, fmt::format("{} of vertex {} is not finite", what, i), kExpected);
  return values;
}

// Returns the positions of integers on the grid. low: attribute of their low bits, or nullptr.
std::vector<glm::dvec3> gridPositions(const draco::PointAttribute& attribute, const draco::PointAttribute* low,
                                      std::uint32_t vertices, const Grid& grid, std::string_view where) {
  const std::int32_t most = static_cast<std::int32_t>((1u << static_cast<unsigned>(grid.positionBits)) - 1u);
  std::vector<glm::dvec3> positions;
  positions.reserve(vertices);
  std::vector<glm::ivec3> integers = attributeValues<glm::ivec3>(attribute, vertices, "position", where);
  if (low != nullptr) {
    const std::vector<glm::ivec3> rest = attributeValues<glm::ivec3>(*low, vertices, "position", where);
    constexpr int kLow = 1 << kLowBits, kHigh = 1 << (kMaxPositionBits - kLowBits);
    for (std::uint32_t i = 0; i < vertices; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        int& k = integers[i][axis];
        const bool isValid = k >= 0 && k < kHigh && rest[i][axis] >= 0 && rest[i][axis] < kLow;
        k = isValid ? k * kLow + rest[i][axis] : -1;
      }
  }
  for (const glm::ivec3& k : integers) {
    if (std::min({k.x, k.y, k.z}) < 0 || std::max({k.x, k.y, k.z}) > most)
      throw Error(where, fmt::format("position of vertex {} is outside of its grid", positions.size()),
                  fmt::format("0 to {} steps", most), fmt::format("({}, {}, {})", k.x, k.y, k.z));
    positions.push_back(grid.origin + glm::dvec3(k) * grid.step);
  }
  return positions;
}

// Throws Error unless the header declares the expected counts, and not more than the bytes may contain.
void checkCounts(const DracoHeader& header, std::size_t size, const Limits& limits, std::string_view where) {
  if (header.vertices != limits.vertices || header.triangles != limits.triangles)
    throw Error(where, "Draco data has unexpected counts",
                fmt::format("{} vertices and {} triangles", limits.vertices, limits.triangles),
                fmt::format("{} and {}", header.vertices, header.triangles));
  if (limits.triangles > kMaxTriangles || limits.vertices > kMaxTriangles || limits.vertices == 0)
    throw Error(where, "Draco data has unsupported counts",
                fmt::format("1 to {} vertices and triangles", kMaxTriangles),
                fmt::format("{} and {}", limits.vertices, limits.triangles));

  const std::uint64_t most = kMaxPerByte * size;
  if (limits.triangles > most || limits.vertices > most)
    throw Error(where, "Draco data is too small for its declared counts",
                fmt::format("at most {} vertices and triangles in {} bytes", most, size),
                fmt::format("{} and {}", limits.vertices, limits.triangles));
}

// grid: of integer positions; nullptr: positions are floats.
TriangleMesh decodeMesh(std::span<const std::byte> bytes, const Limits& limits, const Grid* grid,
                        std::string_view where) {
  const DracoHeader header = parseHeader(bytes, where);
  checkCounts(header, bytes.size(), limits, where);

  // Decode.
  const draco::DataType positionType = grid != nullptr ? draco::DT_INT32 : draco::DT_FLOAT32;
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Mesh mesh;
  if (header.method == Method::kSequential) {
    runDecoder<draco::MeshSequentialDecoder>(buffer, limits, positionType, mesh, where);
  } else {
    runDecoder<draco::MeshEdgebreakerDecoder>(buffer, limits, positionType, mesh, where);
  }
  if (mesh.num_points() != limits.vertices || mesh.num_faces() != limits.triangles)
    throw Error(where, "Draco data decodes to unexpected counts",
                fmt::format("{} vertices and {} triangles", limits.vertices, limits.triangles),
                fmt::format("{} and {}", mesh.num_points(), mesh.num_faces()));

  // Copy and check all values.
  TriangleMesh result;
  const draco::PointAttribute& positions = *mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (grid != nullptr) {
    result.positions = gridPositions(positions, mesh.GetNamedAttribute(draco::GeometryAttribute::GENERIC),
                                     limits.vertices, *grid, where);
  } else {
    for (const glm::vec3& p : finiteValues(positions, limits.vertices, "position", where))
      result.positions.emplace_back(p);
  }
  if (const auto* normals = mesh.GetNamedAttribute(draco::GeometryAttribute::NORMAL); normals != nullptr) {
    result.normals = finiteValues(*normals, limits.vertices, "normal", where);
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

}  // namespace

Limits declaredCounts(std::span<const std::byte> bytes, std::string_view where) {
  const DracoHeader header = parseHeader(bytes, where);
  return {header.vertices, header.triangles};
}

TriangleMesh decode(std::span<const std::byte> bytes, const Limits& limits, const Grid& grid, std::string_view where) {
  requireValid(grid, where);
  return decodeMesh(bytes, limits, &grid, where);
}

TriangleMesh decodeFloats(std::span<const std::byte> bytes, const Limits& limits, std::string_view where) {
  return decodeMesh(bytes, limits, nullptr, where);
}

}  // namespace malus::compress
