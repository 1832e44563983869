#include "meshprep/compress/draco_write.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <draco/compression/config/encoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_encoder.h>
#include <draco/compression/mesh/mesh_sequential_encoder.h>
#include <draco/core/encoder_buffer.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "meshprep/base/error.h"

namespace malus::compress {

namespace {

constexpr std::string_view kLocation = "mesh to compress";

// Draco's speed from 0 (smallest file) to 10. Speed 6: plain edgebreaker with one connectivity for positions and
// normals, parallelogram prediction. Measured on a torus with bumps of a million triangles with smooth normals: speed 3
// (valence, normals predicted from faces) 1.39 bytes per triangle, decoded in 246 ms; speed 6: 2.26 bytes, 92 ms; speed
// 6 with normals predicted from faces: 1.64 bytes, 186 ms. Speed 6 is chosen because a pack is loaded more often than
// transferred. The scanned engine has 6.0 to 6.1 bytes per triangle with all of them.
constexpr int kSpeed = 6;

constexpr int kLowMask = (1 << kLowBits) - 1;

// Adds an attribute of the vectors valueAt(0) to valueAt(count - 1) with components of the type that dataType names.
template <class ValueAt>
int addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType dataType, std::size_t count,
                 ValueAt valueAt) {
  using Vector = decltype(valueAt(std::size_t{0}));
  draco::GeometryAttribute description;
  description.Init(type, nullptr, static_cast<std::int8_t>(Vector::length()), dataType, false, sizeof(Vector), 0);
  const int id = mesh.AddAttribute(description, true, static_cast<std::uint32_t>(count));
  std::uint8_t* const values = mesh.attribute(id)->buffer()->data();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector value = valueAt(i);
    std::memcpy(values + i * sizeof(Vector), &value, sizeof(Vector));
  }
  return id;
}

bool areSplit(std::span<const glm::ivec2> coordinates) {
  return std::any_of(coordinates.begin(), coordinates.end(),
                     [](const glm::ivec2& k) { return std::max(k.x, k.y) >= 1 << kPlainBits; });
}

// Adds the attributes of textures.
void addTextures(draco::Mesh& mesh, const RoundedTextures& textures) {
  for (const std::vector<glm::ivec2>& set : textures.coordinates) {
    if (set.empty()) continue;
    if (areSplit(set))
      addAttribute(mesh, draco::GeometryAttribute::TEX_COORD, draco::DT_INT32, set.size(),
                   [&](std::size_t i) { return glm::ivec4(set[i] >> kLowBits, set[i] & kLowMask); });
    else
      addAttribute(mesh, draco::GeometryAttribute::TEX_COORD, draco::DT_INT32, set.size(),
                   [&](std::size_t i) { return set[i]; });
  }
  if (!textures.tangents.empty())
    addAttribute(mesh, draco::GeometryAttribute::GENERIC, draco::DT_INT32, textures.tangents.size(),
                 [&](std::size_t i) { return textures.tangents[i]; });
}

// Integers of positions on a grid.
class GridIntegers {
 public:
  // Throws Error if a position is not on the grid: decoding would not give it.
  GridIntegers(std::span<const glm::dvec3> positions, const Grid& grid) : positions_(positions), grid_(grid) {
    const double most = std::ldexp(1.0, grid.positionBits) - 1;
    glm::ivec3 largest(0);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const glm::dvec3& p = positions[i];
      const glm::dvec3 k = (p - grid.origin) / grid.step;
      const bool isInside = glm::all(glm::greaterThanEqual(k, glm::dvec3(0))) &&
                            glm::all(glm::lessThanEqual(k, glm::dvec3(most)));  // false for NaN
      if (!isInside || grid.origin + glm::dvec3(glm::ivec3(k)) * grid.step != p) refuse(i, most);
      largest = glm::max(largest, glm::ivec3(k));
    }
    isSplit_ = std::max({largest.x, largest.y, largest.z}) >= 1 << kPlainBits;
  }

  bool isSplit() const { return isSplit_; }
  glm::ivec3 operator[](std::size_t i) const { return glm::ivec3((positions_[i] - grid_.origin) / grid_.step); }

 private:
  [[noreturn]] void refuse(std::size_t i, double most) const {
    const glm::dvec3 p = positions_[i], origin = grid_.origin;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Error(kLocation, fmt::format("position {} is not finite", i));
    throw Error(
        kLocation, fmt::format("position {} is outside of the grid", i),
        fmt::format("0 to {} steps of {:g} m from ({:g}, {:g}, {:g})", most, grid_.step, origin.x, origin.y, origin.z),
        fmt::format("({:.17g}, {:.17g}, {:.17g})", p.x, p.y, p.z));
  }

  std::span<const glm::dvec3> positions_;
  const Grid& grid_;
  bool isSplit_ = false;
};

// Returns the vertex of each encoded value. Draco lists a corner of each.
std::vector<std::uint32_t> valueVertices(const draco::MeshEdgebreakerEncoder& encoder, const draco::Mesh& mesh) {
  std::vector<std::uint32_t> vertices;
  const int positions = mesh.GetNamedAttributeId(draco::GeometryAttribute::POSITION);
  const draco::MeshAttributeIndicesEncodingData* order = encoder.GetAttributeEncodingData(positions);
  if (order == nullptr) return vertices;
  vertices.reserve(order->encoded_attribute_value_index_to_corner_map.size());
  for (const draco::CornerIndex& corner : order->encoded_attribute_value_index_to_corner_map)
    vertices.push_back(mesh.CornerToPointId(corner).value());
  return vertices;
}

template <class Encoder>
std::optional<DracoBytes> runEncoder(Encoder& encoder, const draco::Mesh& mesh, int normalBits) {
  draco::EncoderOptions options = draco::EncoderOptions::CreateDefaultOptions();
  options.SetSpeed(kSpeed, kSpeed);
  const int normals = mesh.GetNamedAttributeId(draco::GeometryAttribute::NORMAL);
  if (normals >= 0) options.SetAttributeInt(normals, "quantization_bits", normalBits);
  encoder.SetMesh(mesh);
  draco::EncoderBuffer buffer;
  if (!encoder.Encode(options, &buffer).ok()) return std::nullopt;
  DracoBytes result;
  const auto* data = reinterpret_cast<const std::byte*>(buffer.data());
  result.bytes.assign(data, data + buffer.size());
  return result;
}

}  // namespace

std::unique_ptr<draco::Mesh> makeDracoMesh(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Grid& grid,
                                           const RoundedTextures& textures) {
  auto result = std::make_unique<draco::Mesh>();
  result->set_num_points(static_cast<std::uint32_t>(rounded.size()));
  result->SetNumFaces(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    result->SetFace(draco::FaceIndex(i), {draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
  }
  const GridIntegers integers(rounded, grid);
  const auto addIntegers = [&](draco::GeometryAttribute::Type type, auto integerAt) {
    addAttribute(*result, type, draco::DT_INT32, rounded.size(), integerAt);
  };
  if (integers.isSplit()) {
    addIntegers(draco::GeometryAttribute::POSITION, [&](std::size_t i) { return integers[i] >> kLowBits; });
    addIntegers(draco::GeometryAttribute::GENERIC, [&](std::size_t i) { return integers[i] & kLowMask; });
  } else {
    addIntegers(draco::GeometryAttribute::POSITION, [&](std::size_t i) { return integers[i]; });
  }
  if (!mesh.normals.empty())
    addAttribute(*result, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, mesh.normals.size(),
                 [&](std::size_t i) { return mesh.normals[i]; });
  addTextures(*result, textures);
  return result;
}

std::optional<DracoBytes> writeDraco(Method method, const draco::Mesh& mesh, int normalBits) {
  if (method == Method::kSequential) {
    draco::MeshSequentialEncoder encoder;
    return runEncoder(encoder, mesh, normalBits);
  }
  draco::MeshEdgebreakerEncoder encoder;
  std::optional<DracoBytes> result = runEncoder(encoder, mesh, normalBits);
  if (result) result->vertexOfValue = valueVertices(encoder, mesh);
  return result;
}

std::size_t leastSequentialBytes(const draco::Mesh& mesh) {
  // Source: Draco bitstream specification 2.2, "Sequential indices": 8 or 16 bits, varints, or 32 bits.
  const std::size_t indices = 3 * std::size_t{mesh.num_faces()};
  const std::uint32_t points = mesh.num_points();
  if (points < 1u << 8u) return indices;
  if (points < 1u << 16u) return 2 * indices;
  if (points >= 1u << 21u) return 4 * indices;
  std::size_t bytes = indices;
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
    for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(i)))
      bytes += (point.value() >= 1u << 7u ? 1u : 0u) + (point.value() >= 1u << 14u ? 1u : 0u);
  return bytes;
}

}  // namespace malus::compress
