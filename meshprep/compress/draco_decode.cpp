// Decoding of untrusted bytes: counts are checked before Draco runs, attributes before their values are allocated, and
// all values afterwards.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <functional>
#include <string>

#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/draco_header.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/compress/draco_read.h"
#include "meshprep/compress/draco_write.h"

namespace malus::compress {

namespace {

constexpr const char* kExpected = "data as malus writes it; bake or prepare the mesh again";

// Type of the position attribute: integers of a grid, or floats in packs of format version 1.
bool hasType(const draco::PointAttribute& attribute, draco::DataType type) {
  return attribute.num_components() == 3 && attribute.data_type() == type;
}

// Attributes that a file must have.
struct ExpectedAttributes {
  draco::DataType positionType = draco::DT_INT32;
  TextureGrids textures;
  int sets() const { return (textures.sets[0].step > 0 ? 1 : 0) + (textures.sets[1].step > 0 ? 1 : 0); }
  int tangents() const { return textures.tangentBits > 0 ? 1 : 0; }
};

bool isTangent(const draco::PointAttribute& attribute) {
  return attribute.attribute_type() == draco::GeometryAttribute::GENERIC &&
         attribute.num_components() == kTangentComponents;
}

bool hasExpectedType(const draco::PointAttribute& attribute, const ExpectedAttributes& expected) {
  const int components = attribute.num_components();
  if (attribute.attribute_type() == draco::GeometryAttribute::NORMAL) return hasType(attribute, draco::DT_FLOAT32);
  if (attribute.attribute_type() == draco::GeometryAttribute::TEX_COORD)
    return attribute.data_type() == draco::DT_INT32 && (components == 2 || components == 4);
  if (isTangent(attribute)) return attribute.data_type() == draco::DT_INT32;
  return hasType(attribute, expected.positionType);
}

// Returns true if the attributes are one position of the given type, at most one float normal, for integers at most one
// generic attribute of three integers, the low bits of the positions, and the attributes of textures.
bool hasExpectedAttributes(const draco::PointCloud& cloud, const ExpectedAttributes& expected) {
  if (cloud.NumNamedAttributes(draco::GeometryAttribute::POSITION) != 1) return false;
  const int normals = cloud.NumNamedAttributes(draco::GeometryAttribute::NORMAL);
  const int generics = cloud.NumNamedAttributes(draco::GeometryAttribute::GENERIC);
  const int sets = cloud.NumNamedAttributes(draco::GeometryAttribute::TEX_COORD);
  int tangents = 0;
  for (int i = 0; i < cloud.num_attributes(); ++i) {
    if (!hasExpectedType(*cloud.attribute(i), expected)) return false;
    tangents += isTangent(*cloud.attribute(i)) ? 1 : 0;
  }
  const int lows = generics - tangents;
  return normals <= 1 && lows <= (expected.positionType == draco::DT_INT32 ? 1 : 0) && sets == expected.sets() &&
         tangents == expected.tangents() && cloud.num_attributes() == 1 + normals + generics + sets;
}

// Decoder of Draco that checks the attributes' descriptions before it decodes their values: a few bytes can declare
// gigabytes.
template <class Base>
class CheckedDecoder : public Base {
 public:
  CheckedDecoder(const Limits& limits, const ExpectedAttributes& expected) : limits_(limits), expected_(expected) {}

 protected:
  bool DecodeConnectivity() override {
    return Base::DecodeConnectivity() && this->point_cloud()->num_points() == limits_.vertices &&
           this->mesh()->num_faces() == limits_.triangles;
  }
  bool DecodeAllAttributes() override {
    return hasExpectedAttributes(*this->point_cloud(), expected_) && Base::DecodeAllAttributes();
  }

 private:
  Limits limits_;
  ExpectedAttributes expected_;
};

template <class Base>
void runDecoder(draco::DecoderBuffer& buffer, const Limits& limits, const ExpectedAttributes& expected,
                draco::Mesh& mesh, std::string_view where) {
  CheckedDecoder<Base> decoder(limits, expected);
  const draco::DecoderOptions options;
  draco::Status status;
  try {
    status = decoder.Decode(options, &buffer, &mesh);
  } catch (const std::exception& failure) {  // std::bad_alloc and std::length_error, from corrupt sizes
    throw Error(where, fmt::format("Draco data is corrupt: {}", failure.what()), kExpected);
  }
  if (!status.ok()) throw Error(where, fmt::format("Draco data is corrupt: {}", status.error_msg_string()), kExpected);
}

// Returns the values of an attribute, one per vertex. Vector: as many values of the attribute's type as it has.
template <class Vector>
std::vector<Vector> attributeValues(const draco::PointAttribute& attribute, std::uint32_t vertices,
                                    std::string_view what, std::string_view where) {
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
      std::memcpy(&values[i], attribute.GetAddress(index), sizeof(Vector));
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

// Decodes the attributes of textures. Corrupt integers give values out of range.
void readTextures(const draco::Mesh& mesh, const TextureGrids& grids, std::string_view where, TriangleMesh& result) {
  const std::uint32_t vertices = mesh.num_points();
  int id = 0;
  for (std::size_t set = 0; set < grids.sets.size(); ++set) {
    if (grids.sets[set].step == 0) continue;
    const draco::PointAttribute& attribute = *mesh.GetNamedAttribute(draco::GeometryAttribute::TEX_COORD, id++);
    std::vector<glm::ivec2> integers;
    if (attribute.num_components() == 2) {
      integers = attributeValues<glm::ivec2>(attribute, vertices, "texture coordinate", where);
    } else {
      for (const glm::ivec4& k : attributeValues<glm::ivec4>(attribute, vertices, "texture coordinate", where)) {
        constexpr int kHigh = 1 << (kMaxCoordinateBits - kLowBits);
        const bool isValid =
            std::min({k.x, k.y, k.z, k.w}) >= 0 && std::max(k.x, k.y) < kHigh && std::max(k.z, k.w) < 1 << kLowBits;
        integers.push_back(isValid ? glm::ivec2(k.x << kLowBits | k.z, k.y << kLowBits | k.w) : glm::ivec2(-1));
      }
    }
    for (const glm::ivec2& k : integers) {
      const glm::vec2 uv = decodedCoordinate(grids.sets[set], k);
      if (std::min(k.x, k.y) < 0 || std::max(k.x, k.y) >= 1 << kMaxCoordinateBits ||
          !(std::max(std::abs(uv.x), std::abs(uv.y)) <=
            static_cast<float>(kMaxTextureCoordinate + grids.sets[set].step)))
        throw Error(where, "texture coordinate is out of range", fmt::format("up to {:g}", kMaxTextureCoordinate),
                    fmt::format("({}, {}) steps of {:g}", k.x, k.y, grids.sets[set].step));
      result.textureCoordinates[set].push_back(uv);
    }
  }
  if (grids.tangentBits == 0) return;
  int generic = 0;
  while (!isTangent(*mesh.GetNamedAttribute(draco::GeometryAttribute::GENERIC, generic))) ++generic;
  const int most = (1 << grids.tangentBits) - 2;
  for (const glm::ivec2& k : attributeValues<glm::ivec2>(
           *mesh.GetNamedAttribute(draco::GeometryAttribute::GENERIC, generic), vertices, "tangent", where)) {
    if (std::min(k.x, k.y) < 0 || k.x > most || k.y / 2 > most)
      throw Error(where, "tangent is out of range", fmt::format("0 to {}", most),
                  fmt::format("({}, {})", k.x, k.y / 2));
    result.tangents.push_back(decodedTangent(k, grids.tangentBits));
  }
}

// Returns the low bits of the positions, or nullptr.
const draco::PointAttribute* lowBits(const draco::Mesh& mesh) {
  for (int i = 0; i < mesh.NumNamedAttributes(draco::GeometryAttribute::GENERIC); ++i)
    if (const auto* attribute = mesh.GetNamedAttribute(draco::GeometryAttribute::GENERIC, i); !isTangent(*attribute))
      return attribute;
  return nullptr;
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

std::vector<glm::dvec3> readPositions(const draco::Mesh& mesh, const Limits& limits, const Grid* grid,
                                      std::string_view where) {
  const draco::PointAttribute& positions = *mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (grid != nullptr) return gridPositions(positions, lowBits(mesh), limits.vertices, *grid, where);
  const std::vector<glm::vec3> floats = finiteValues(positions, limits.vertices, "position", where);
  return {floats.begin(), floats.end()};
}

std::vector<glm::vec3> readNormals(const draco::Mesh& mesh, const Limits& limits, std::string_view where) {
  const auto* attribute = mesh.GetNamedAttribute(draco::GeometryAttribute::NORMAL);
  if (attribute == nullptr) return {};
  std::vector<glm::vec3> normals = finiteValues(*attribute, limits.vertices, "normal", where);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float length = glm::length(normals[i]);
    if (!(length > 0.5f && length < 2.0f))
      throw Error(where, fmt::format("normal of vertex {} has an invalid length", i), "1", fmt::format("{}", length));
    normals[i] /= length;
  }
  return normals;
}

std::vector<glm::uvec3> readTriangles(const draco::Mesh& mesh) {
  std::vector<glm::uvec3> triangles;
  triangles.reserve(mesh.num_faces());
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    triangles.emplace_back(face[0].value(), face[1].value(), face[2].value());
  }
  return triangles;
}

// grid: of integer positions; nullptr: positions are floats.
TriangleMesh decodeMesh(std::span<const std::byte> bytes, const Limits& limits, const Grid* grid,
                        const TextureGrids& textures, std::string_view where) {
  draco::Mesh mesh;
  readDraco(bytes, limits, grid != nullptr ? draco::DT_INT32 : draco::DT_FLOAT32, textures, where, mesh);

  // Copy and check all values, the parts at the same time. The error is that of the first part that has one. Tasks of
  // the caller, as other meshes, do not run in between.
  TriangleMesh result;
  const std::array<std::function<void()>, 4> parts = {
      [&] { result.positions = readPositions(mesh, limits, grid, where); },
      [&] { result.normals = readNormals(mesh, limits, where); },
      [&] { readTextures(mesh, textures, where, result); },
      [&] { result.triangles = readTriangles(mesh); },
  };
  std::array<std::exception_ptr, 4> errors;
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      try {
        parts[i]();
      } catch (...) {
        errors[i] = std::current_exception();
      }
    });
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return result;
}

}  // namespace

void readDraco(std::span<const std::byte> bytes, const Limits& limits, draco::DataType positionType,
               const TextureGrids& textures, std::string_view where, draco::Mesh& mesh) {
  const DracoHeader header = parseHeader(bytes, where);
  checkCounts(header, bytes.size(), limits, where);
  const ExpectedAttributes expected{positionType, textures};
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (header.method == Method::kSequential) {
    runDecoder<draco::MeshSequentialDecoder>(buffer, limits, expected, mesh, where);
  } else {
    runDecoder<draco::MeshEdgebreakerDecoder>(buffer, limits, expected, mesh, where);
  }
  if (mesh.num_points() != limits.vertices || mesh.num_faces() != limits.triangles)
    throw Error(where, "Draco data decodes to unexpected counts",
                fmt::format("{} vertices and {} triangles", limits.vertices, limits.triangles),
                fmt::format("{} and {}", mesh.num_points(), mesh.num_faces()));
  for (std::uint32_t i = 0; i < limits.triangles; ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    if (std::max({face[0].value(), face[1].value(), face[2].value()}) >= limits.vertices)
      throw Error(where, fmt::format("invalid vertex index in triangle {}", i),
                  fmt::format("an index below {}", limits.vertices));
  }
}

Limits declaredCounts(std::span<const std::byte> bytes, std::string_view where) {
  const DracoHeader header = parseHeader(bytes, where);
  return {header.vertices, header.triangles};
}

TriangleMesh decode(std::span<const std::byte> bytes, const Limits& limits, const Grid& grid, std::string_view where,
                    const TextureGrids& textures) {
  requireValid(grid, where);
  requireValid(textures, where);
  return decodeMesh(bytes, limits, &grid, textures, where);
}

TriangleMesh decodeFloats(std::span<const std::byte> bytes, const Limits& limits, std::string_view where) {
  return decodeMesh(bytes, limits, nullptr, {}, where);
}

}  // namespace malus::compress
