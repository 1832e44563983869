// Encoding, proved by decoding. The sequential encoding is compared with the input; the edgebreaker
// encoding is compared with the sequential one, whose values went through the same quantization.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/deviation.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/compress/draco_write.h"
#include "meshprep/compress/reordering.h"

namespace malus::compress {

namespace {

constexpr float kMinExtent = 1e-30f;  // of a mesh: below, the inverse of a step leaves the range of float
constexpr std::string_view kWhere = "mesh to compress";

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

void checkInput(const MeshView& mesh, const Settings& settings) {
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

// The sequential result must be the input, in its order, within the steps of the grid.
void compareWithSource(const MeshView& mesh, const Settings& settings, Encoded& encoded) {
  const TriangleMesh& decoded = encoded.decoded;
  if (!std::equal(decoded.triangles.begin(), decoded.triangles.end(), mesh.triangles.begin(), mesh.triangles.end()) ||
      decoded.positions.size() != mesh.positions.size() || decoded.normals.size() != mesh.normals.size())
    throw Error(kWhere, "Draco changed the triangles", "the same indices in the same order");
  const float tolerance = axisTolerance(settings.grid);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 off = glm::abs(decoded.positions[i] - mesh.positions[i]);
    if (std::max({off.x, off.y, off.z}) > tolerance)
      throw Error(kWhere, fmt::format("Draco moved position {}", i), fmt::format("at most {}", tolerance),
                  fmt::format("{}", glm::length(off)));
  }
  encoded.deviation = deviationOf(mesh, decoded.positions, decoded.normals);
  if (!(encoded.deviation.normalMaxDegrees <= normalTolerance(settings.normalBits)))
    throw Error(kWhere, "Draco turned a normal",
                fmt::format("at most {} degrees", normalTolerance(settings.normalBits)),
                fmt::format("{}", encoded.deviation.normalMaxDegrees));
}

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<std::uint32_t> identity(std::size_t size) {
  std::vector<std::uint32_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

// Replaces the sequential encoding by edgebreaker's where that is smaller and the same. Returns why not, or "".
std::string tryEdgebreaker(const MeshView& mesh, const Settings& settings, const Limits& limits, Encoded& encoded) {
  // Step 1: bytes.
  const Clock::time_point start = Clock::now();
  std::optional<std::vector<std::byte>> bytes = dracoBytes(Method::kEdgebreaker, mesh, settings);
  const double encodeMs = millisecondsSince(start);
  if (!bytes) return "edgebreaker refuses the mesh";
  if (bytes->size() >= encoded.bytes.size()) return "edgebreaker is no smaller";
  if (std::max(limits.vertices, limits.triangles) > kMostPerByte * bytes->size())
    return "edgebreaker makes the mesh smaller than a reader trusts";

  // Step 2: decoded, the same in another order.
  const Clock::time_point decoding = Clock::now();
  TriangleMesh decoded;
  try {
    decoded = decode(*bytes, limits, kWhere);
  } catch (const Error&) {
    return "edgebreaker changes the counts: faces that are degenerate or not manifold, or loose vertices";
  }
  const double decodeMs = millisecondsSince(decoding);
  std::optional<std::vector<std::uint32_t>> vertices = edgebreakerOrder(mesh);
  if (!vertices) return "the order that edgebreaker gives cannot be told";
  std::optional<std::vector<std::uint32_t>> triangles = sourceTriangles(encoded.decoded, decoded, *vertices);
  if (!triangles) return "edgebreaker changes the triangles";

  encoded.bytes = std::move(*bytes);
  encoded.method = "edgebreaker";
  encoded.decoded = std::move(decoded);
  encoded.sourceVertices = std::move(*vertices);
  encoded.sourceTriangles = std::move(*triangles);
  encoded.encodeMs = encodeMs;
  encoded.decodeMs = decodeMs;
  return {};
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
  if (largest > 0 && largest < kMinExtent)
    throw Error(kWhere, "the mesh is too small", fmt::format("an extent of {} or more", kMinExtent),
                fmt::to_string(largest));
  if (largest > 0) grid.range = largest * (1 + 4 * std::numeric_limits<float>::epsilon());
  if (!isFinite(grid.origin + grid.range)) throw Error(kWhere, "the mesh is too large", "an extent that a float holds");
  return grid;
}

Encoded encode(const MeshView& mesh, const Settings& settings) {
  checkInput(mesh, settings);
  const Limits limits{static_cast<std::uint32_t>(mesh.positions.size()),
                      static_cast<std::uint32_t>(mesh.triangles.size())};

  // Step 1: sequential, compared with the input.
  Encoded encoded;
  const Clock::time_point start = Clock::now();
  std::optional<std::vector<std::byte>> bytes = dracoBytes(Method::kSequential, mesh, settings);
  encoded.encodeMs = millisecondsSince(start);
  if (!bytes) throw Error(kWhere, "Draco cannot encode it");
  encoded.bytes = std::move(*bytes);
  encoded.method = "sequential";
  const Clock::time_point decoding = Clock::now();
  encoded.decoded = decode(encoded.bytes, limits, kWhere);
  encoded.decodeMs = millisecondsSince(decoding);
  compareWithSource(mesh, settings, encoded);
  encoded.sourceVertices = identity(mesh.positions.size());
  encoded.sourceTriangles = identity(mesh.triangles.size());

  // Step 2: edgebreaker, kept where it is smaller and the same surface.
  encoded.whySequential = tryEdgebreaker(mesh, settings, limits, encoded);
  return encoded;
}

}  // namespace malus::compress
