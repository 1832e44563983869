// Encoding, proved by decoding. The sequential encoding is compared with the input; the edgebreaker
// encoding is compared with the sequential one, whose values went through the same quantization.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <draco/compression/expert_encode.h>
#include <draco/core/encoder_buffer.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

namespace {

constexpr std::string_view kWhere = "mesh to compress";
constexpr int kMaxPositionBits = 22;
constexpr int kMinNormalBits = 2;
constexpr int kMaxNormalBits = 16;
constexpr int kSpeed = 3;  // of 0 (smallest) to 10: valence edgebreaker, parallelogram prediction

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// What one position may be off, along one axis: half a step of the grid and the rounding of float.
float axisTolerance(const Grid& grid) {
  const float step = grid.range / static_cast<float>((1u << static_cast<unsigned>(grid.positionBits)) - 1u);
  const float farthest =
      std::max({std::abs(grid.origin.x), std::abs(grid.origin.y), std::abs(grid.origin.z)}) + grid.range;
  return 0.5f * step + 4 * std::numeric_limits<float>::epsilon() * farthest;
}

// An upper bound on the angle that octahedral quantization adds: measured .90 degrees at 8 bits, halved by
// every further bit; doubled here for room, and a little for the rounding of float.
double normalTolerance(int normalBits) { return 2.0 * 0.9 * std::pow(2.0, 8 - normalBits) + 0.05; }

double angleDegrees(const glm::vec3& a, const glm::vec3& b) {
  const glm::dvec3 u(a), v(b);
  return glm::degrees(std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
}

void checkInput(const TriangleMesh& mesh, const Settings& settings) {
  // Step 1: settings.
  const Grid& grid = settings.grid;
  if (grid.positionBits < 1 || grid.positionBits > kMaxPositionBits)
    throw Error(kWhere, "bits of a position", fmt::format("1 to {}", kMaxPositionBits),
                fmt::to_string(grid.positionBits));
  if (settings.normalBits < kMinNormalBits || settings.normalBits > kMaxNormalBits)
    throw Error(kWhere, "bits of a normal", fmt::format("{} to {}", kMinNormalBits, kMaxNormalBits),
                fmt::to_string(settings.normalBits));
  if (!isFinite(grid.origin) || !std::isfinite(grid.range) || !(grid.range > 0) || !isFinite(grid.origin + grid.range))
    throw Error(kWhere, "the grid is no cube", "a finite origin and a positive range");

  // Step 2: sizes.
  if (mesh.positions.empty() || mesh.triangles.empty()) throw Error(kWhere, "the mesh is empty");
  if (mesh.positions.size() > kMaxTriangles || mesh.triangles.size() > kMaxTriangles)
    throw Error(kWhere, "too many vertices or triangles", fmt::format("at most {}", kMaxTriangles));
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
    throw Error(kWhere, "number of normals", fmt::to_string(mesh.positions.size()),
                fmt::to_string(mesh.normals.size()));

  // Step 3: values. The far side gets room for the rounding of origin + range.
  const float room = 2 * std::numeric_limits<float>::epsilon() * (std::abs(grid.range) + glm::length(grid.origin));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 p = mesh.positions[i];
    if (!isFinite(p)) throw Error(kWhere, fmt::format("position {} is not finite", i));
    const glm::vec3 local = p - grid.origin;
    if (glm::any(glm::lessThan(local, glm::vec3(0))) || glm::any(glm::greaterThan(local, glm::vec3(grid.range + room))))
      throw Error(kWhere, fmt::format("position {} lies outside of the grid", i),
                  fmt::format("within {} of ({}, {}, {})", grid.range, grid.origin.x, grid.origin.y, grid.origin.z),
                  fmt::format("({}, {}, {})", p.x, p.y, p.z));
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (!isFinite(mesh.normals[i]) || std::abs(glm::length(mesh.normals[i]) - 1) > 1e-3f)
      throw Error(kWhere, fmt::format("normal {} is not of unit length", i));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size())
      throw Error(kWhere, fmt::format("triangle {} names a vertex that is not there", i),
                  fmt::format("below {}", mesh.positions.size()));
  }
}

int addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, const std::vector<glm::vec3>& values) {
  draco::GeometryAttribute description;
  description.Init(type, nullptr, 3, draco::DT_FLOAT32, false, 3 * sizeof(float), 0);
  const int id = mesh.AddAttribute(description, true, static_cast<std::uint32_t>(values.size()));
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const std::array<float, 3> value{values[i].x, values[i].y, values[i].z};
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), value.data());
  }
  return id;
}

// Bytes of one encoding; nothing where Draco refuses.
std::optional<std::vector<std::byte>> encodeWith(draco::MeshEncoderMethod method, const TriangleMesh& mesh,
                                                 const Settings& settings) {
  // One point a vertex, in our order: no deduplication.
  draco::Mesh source;
  source.set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
  source.SetNumFaces(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    source.SetFace(draco::FaceIndex(i), {draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
  }
  const int positions = addAttribute(source, draco::GeometryAttribute::POSITION, mesh.positions);
  int normals = -1;
  if (!mesh.normals.empty()) normals = addAttribute(source, draco::GeometryAttribute::NORMAL, mesh.normals);

  // Plain quantization to the caller's grid; Draco's own would fit the grid to each mesh.
  draco::ExpertEncoder encoder(source);
  const Grid& grid = settings.grid;
  const std::array<float, 3> origin{grid.origin.x, grid.origin.y, grid.origin.z};
  encoder.SetSpeedOptions(kSpeed, kSpeed);
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeExplicitQuantization(positions, grid.positionBits, 3, origin.data(), grid.range);
  if (normals >= 0) encoder.SetAttributeQuantization(normals, settings.normalBits);

  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) return std::nullopt;
  const auto* data = reinterpret_cast<const std::byte*>(buffer.data());
  return std::vector<std::byte>(data, data + buffer.size());
}

// The sequential result must be the input, in its order, within the steps of the grid.
void compareWithSource(const TriangleMesh& mesh, const Settings& settings, Encoded& encoded) {
  const TriangleMesh& decoded = encoded.decoded;
  if (decoded.triangles != mesh.triangles || decoded.positions.size() != mesh.positions.size() ||
      decoded.normals.size() != mesh.normals.size())
    throw Error(kWhere, "Draco changed the triangles", "the same indices in the same order");
  const float tolerance = axisTolerance(settings.grid);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 off = glm::abs(decoded.positions[i] - mesh.positions[i]);
    if (std::max({off.x, off.y, off.z}) > tolerance)
      throw Error(kWhere, fmt::format("Draco moved position {}", i), fmt::format("at most {}", tolerance),
                  fmt::format("{}", glm::length(off)));
    encoded.positionErrorMax = std::max(encoded.positionErrorMax, glm::length(off));
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const double off = angleDegrees(decoded.normals[i], mesh.normals[i]);
    if (!(off <= normalTolerance(settings.normalBits)))
      throw Error(kWhere, fmt::format("Draco turned normal {}", i),
                  fmt::format("at most {} degrees", normalTolerance(settings.normalBits)), fmt::format("{}", off));
    encoded.normalErrorMaxDegrees = std::max(encoded.normalErrorMaxDegrees, static_cast<float>(off));
  }
}

// One vertex by value: bit-equal results of the same quantization compare equal.
using VertexValue = std::array<float, 6>;

std::vector<VertexValue> vertexValues(const TriangleMesh& mesh) {
  std::vector<VertexValue> values(mesh.positions.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::vec3 p = mesh.positions[i];
    const glm::vec3 n = mesh.normals.empty() ? glm::vec3(0) : mesh.normals[i];
    values[i] = {p.x, p.y, p.z, n.x, n.y, n.z};
  }
  return values;
}

// Triangles as ranks of their corners' values, turned so that the smallest turn comes first (orientation
// is kept), sorted. Empty where a corner's value is not among `distinct`.
std::vector<std::array<std::size_t, 3>> canonicalTriangles(const TriangleMesh& mesh,
                                                           const std::vector<VertexValue>& distinct) {
  std::vector<std::size_t> rank(mesh.positions.size());
  const std::vector<VertexValue> values = vertexValues(mesh);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto found = std::lower_bound(distinct.begin(), distinct.end(), values[i]);
    if (found == distinct.end() || *found != values[i]) return {};
    rank[i] = static_cast<std::size_t>(found - distinct.begin());
  }
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const std::size_t a = rank[t.x], b = rank[t.y], c = rank[t.z];
    triangles.push_back(std::min({std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

bool sameSurface(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.positions.size() != b.positions.size() || a.normals.size() != b.normals.size() ||
      a.triangles.size() != b.triangles.size())
    return false;
  std::vector<VertexValue> valuesA = vertexValues(a), valuesB = vertexValues(b);
  std::sort(valuesA.begin(), valuesA.end());
  std::sort(valuesB.begin(), valuesB.end());
  if (valuesA != valuesB) return false;
  valuesA.erase(std::unique(valuesA.begin(), valuesA.end()), valuesA.end());
  return canonicalTriangles(a, valuesA) == canonicalTriangles(b, valuesA);
}

}  // namespace

Grid gridFor(std::span<const glm::vec3> positions, int positionBits) {
  Grid grid;
  grid.positionBits = positionBits;
  if (positions.empty()) return grid;
  glm::vec3 low = positions.front(), high = positions.front();
  for (const glm::vec3& p : positions) {
    if (!isFinite(p)) throw Error(kWhere, "a position is not finite");
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 extent = high - low;
  const float largest = std::max({extent.x, extent.y, extent.z});
  grid.origin = low;
  if (largest > 0) grid.range = largest * (1 + 4 * std::numeric_limits<float>::epsilon());
  if (!isFinite(grid.origin + grid.range)) throw Error(kWhere, "the mesh is too large", "an extent that a float holds");
  return grid;
}

Encoded encode(const TriangleMesh& mesh, const Settings& settings) {
  checkInput(mesh, settings);
  const Limits limits{static_cast<std::uint32_t>(mesh.positions.size()),
                      static_cast<std::uint32_t>(mesh.triangles.size())};

  // Step 1: sequential, compared with the input.
  Encoded encoded;
  std::optional<std::vector<std::byte>> bytes = encodeWith(draco::MESH_SEQUENTIAL_ENCODING, mesh, settings);
  if (!bytes) throw Error(kWhere, "Draco cannot encode it");
  encoded.bytes = std::move(*bytes);
  encoded.method = "sequential";
  encoded.decoded = decode(encoded.bytes, limits, kWhere);
  compareWithSource(mesh, settings, encoded);

  // Step 2: edgebreaker, kept where it is smaller and the same surface.
  bytes = encodeWith(draco::MESH_EDGEBREAKER_ENCODING, mesh, settings);
  if (!bytes || bytes->size() >= encoded.bytes.size()) return encoded;
  try {
    TriangleMesh decoded = decode(*bytes, limits, kWhere);
    if (!sameSurface(encoded.decoded, decoded)) return encoded;
    encoded.decoded = std::move(decoded);
  } catch (const Error&) {
    return encoded;  // other counts: vertices or triangles were split, dropped or merged
  }
  encoded.bytes = std::move(*bytes);
  encoded.method = "edgebreaker";
  return encoded;
}

}  // namespace malus::compress
