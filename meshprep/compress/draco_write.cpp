#include "meshprep/compress/draco_write.h"

#include <algorithm>
#include <array>
#include <span>

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/core/encoder_buffer.h>
#include <draco/mesh/mesh.h>

namespace malus::compress {

namespace {

// Draco's speed from 0 (smallest file) to 10. Speed 6: plain edgebreaker with one connectivity for positions and
// normals, parallelogram prediction. Measured on a torus with bumps of a million triangles with smooth normals: speed 3
// (valence, normals predicted from faces) 1.39 bytes per triangle, decoded in 246 ms; speed 6: 2.26 bytes, 92 ms; speed
// 6 with normals predicted from faces: 1.64 bytes, 186 ms. Speed 6 is chosen because a pack is loaded more often than
// transferred. The scanned engine has 6.0 to 6.1 bytes per triangle with all of them.
constexpr int kSpeed = 6;

// Adds an attribute of the vectors valueAt(0) to valueAt(count - 1) with components of the type that dataType names.
template <class ValueAt>
int addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType dataType, std::size_t count,
                 ValueAt valueAt) {
  using Vector = decltype(valueAt(std::size_t{0}));
  draco::GeometryAttribute description;
  description.Init(type, nullptr, static_cast<std::int8_t>(Vector::length()), dataType, false, sizeof(Vector), 0);
  const int id = mesh.AddAttribute(description, true, static_cast<std::uint32_t>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vector value = valueAt(i);
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &value);
  }
  return id;
}

constexpr int kLowMask = (1 << kLowBits) - 1;

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

// Adds an attribute with the index of each vertex in all components.
int addNumbers(draco::Mesh& mesh, draco::GeometryAttribute::Type type, std::int8_t components, std::size_t vertices) {
  draco::GeometryAttribute description;
  description.Init(type, nullptr, components, draco::DT_INT32, false,
                   components * static_cast<std::int64_t>(sizeof(std::int32_t)), 0);
  const int id = mesh.AddAttribute(description, true, static_cast<std::uint32_t>(vertices));
  for (std::uint32_t i = 0; i < vertices; ++i) {
    std::array<std::int32_t, 3> number{};
    number.fill(static_cast<std::int32_t>(i));
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), number.data());
  }
  return id;
}

// Sets one point per vertex in the order of the mesh, without deduplication.
void setTriangles(draco::Mesh& result, const MeshView& mesh) {
  result.set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
  result.SetNumFaces(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    result.SetFace(draco::FaceIndex(i), {draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
  }
}

}  // namespace

bool areSplit(std::span<const glm::ivec3> positions) {
  return std::any_of(positions.begin(), positions.end(), [](const glm::ivec3& k) {
    return std::max({k.x, k.y, k.z}) >= 1 << kPlainBits;
  });
}

std::optional<std::vector<std::byte>> encodeDraco(Method method, const MeshView& mesh,
                                                  std::span<const glm::ivec3> positions, int normalBits,
                                                  const RoundedTextures& textures) {
  draco::Mesh source;
  setTriangles(source, mesh);
  const auto addIntegers = [&](draco::GeometryAttribute::Type type, auto integerAt) {
    addAttribute(source, type, draco::DT_INT32, positions.size(), integerAt);
  };
  if (areSplit(positions)) {
    addIntegers(draco::GeometryAttribute::POSITION, [&](std::size_t i) { return positions[i] >> kLowBits; });
    addIntegers(draco::GeometryAttribute::GENERIC, [&](std::size_t i) { return positions[i] & kLowMask; });
  } else {
    addIntegers(draco::GeometryAttribute::POSITION, [&](std::size_t i) { return positions[i]; });
  }
  const int normals = mesh.normals.empty()
                          ? -1
                          : addAttribute(source, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32,
                                         mesh.normals.size(), [&](std::size_t i) { return mesh.normals[i]; });

  addTextures(source, textures);

  draco::ExpertEncoder encoder(source);
  encoder.SetSpeedOptions(kSpeed, kSpeed);
  encoder.SetEncodingMethod(method == Method::kSequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                          : draco::MESH_EDGEBREAKER_ENCODING);
  if (normals >= 0) encoder.SetAttributeQuantization(normals, normalBits);

  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) return std::nullopt;
  const auto* data = reinterpret_cast<const std::byte*>(buffer.data());
  return std::vector<std::byte>(data, data + buffer.size());
}

std::optional<std::vector<std::uint32_t>> edgebreakerOrder(const MeshView& mesh, std::span<const glm::ivec3> positions,
                                                           const RoundedTextures& textures) {
  // Encode the same connectivity and the same number of attributes, on which the order depends.
  draco::Mesh source;
  setTriangles(source, mesh);
  addNumbers(source, draco::GeometryAttribute::POSITION, 3, mesh.positions.size());
  if (areSplit(positions)) addNumbers(source, draco::GeometryAttribute::GENERIC, 3, mesh.positions.size());
  if (!mesh.normals.empty()) addNumbers(source, draco::GeometryAttribute::GENERIC, 1, mesh.positions.size());
  addTextures(source, textures);
  draco::ExpertEncoder encoder(source);
  encoder.SetSpeedOptions(kSpeed, kSpeed);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) return std::nullopt;

  // Read the numbers in the order of decoding.
  draco::DecoderBuffer input;
  input.Init(buffer.data(), buffer.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&input);
  if (!decoded.ok()) return std::nullopt;
  const draco::PointAttribute* numbers = decoded.value()->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  std::vector<std::uint32_t> order(decoded.value()->num_points());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    std::array<std::int32_t, 3> number{};
    numbers->GetValue(numbers->mapped_index(draco::PointIndex(i)), number.data());
    order[i] = static_cast<std::uint32_t>(number[0]);
  }
  return order;
}

}  // namespace malus::compress
