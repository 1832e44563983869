// Encoding with verification. The sequential result is compared with the input, the edgebreaker result with the
// sequential one, which has the same quantized values.
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

constexpr float kMinExtent = 1e-30f;  // smallest extent of a mesh: the inverse of a step must be in the range of float
constexpr std::string_view kLocation = "mesh to compress";

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Returns the largest error of a coordinate: half a step of the grid, and rounding to float.
float axisTolerance(const Grid& grid) {
  const float step = grid.range / static_cast<float>((1u << static_cast<unsigned>(grid.positionBits)) - 1u);
  const float farthest =
      std::max({std::abs(grid.origin.x), std::abs(grid.origin.y), std::abs(grid.origin.z)}) + grid.range;
  return 0.5f * step + 4 * std::numeric_limits<float>::epsilon() * farthest;
}

// Returns an upper bound of the error of octahedral quantization in degrees: twice the measured 0.90 degrees at 8 bits,
// halved by each further bit, and 0.05 degrees for rounding to float.
double normalTolerance(int normalBits) { return 2.0 * 0.9 * std::pow(2.0, 8 - normalBits) + 0.05; }

void checkInput(const MeshView& mesh, const Settings& settings) {
  // Check the settings.
  const Grid& grid = settings.grid;
  if (grid.positionBits < 1 || grid.positionBits > kMaxPositionBits)
    throw Error(kLocation, "number of position bits out of range", fmt::format("1 to {}", kMaxPositionBits),
                fmt::to_string(grid.positionBits));
  if (settings.normalBits < kMinNormalBits || settings.normalBits > kMaxNormalBits)
    throw Error(kLocation, "number of normal bits out of range",
                fmt::format("{} to {}", kMinNormalBits, kMaxNormalBits), fmt::to_string(settings.normalBits));
  if (!isFinite(grid.origin) || !std::isfinite(grid.range) || !(grid.range > 0) || !isFinite(grid.origin + grid.range))
    throw Error(kLocation, "invalid grid", "a finite origin and a positive range");

  // Check the sizes.
  if (mesh.positions.empty() || mesh.triangles.empty()) throw Error(kLocation, "the mesh is empty");
  if (mesh.positions.size() > kMaxTriangles || mesh.triangles.size() > kMaxTriangles)
    throw Error(kLocation, "too many vertices or triangles", fmt::format("at most {}", kMaxTriangles));
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
    throw Error(kLocation, "wrong number of normals", fmt::to_string(mesh.positions.size()),
                fmt::to_string(mesh.normals.size()));

  // Check the values. The tolerance at the far side covers the rounding of origin + range.
  const float room = 2 * std::numeric_limits<float>::epsilon() * (std::abs(grid.range) + glm::length(grid.origin));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 p = mesh.positions[i];
    if (!isFinite(p)) throw Error(kLocation, fmt::format("position {} is not finite", i));
    const glm::vec3 local = p - grid.origin;
    if (glm::any(glm::lessThan(local, glm::vec3(0))) || glm::any(glm::greaterThan(local, glm::vec3(grid.range + room))))
      throw Error(kLocation, fmt::format("position {} is outside of the grid", i),
                  fmt::format("within {} of ({}, {}, {})", grid.range, grid.origin.x, grid.origin.y, grid.origin.z),
                  fmt::format("({}, {}, {})", p.x, p.y, p.z));
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (!isFinite(mesh.normals[i]) || std::abs(glm::length(mesh.normals[i]) - 1) > 1e-3f)
      throw Error(kLocation, fmt::format("normal {} does not have unit length", i));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size())
      throw Error(kLocation, fmt::format("invalid vertex index in triangle {}", i),
                  fmt::format("an index below {}", mesh.positions.size()));
  }
}

// Requires the sequential result to have the triangles of the input, and vertices within the tolerances.
void compareWithSource(const MeshView& mesh, const Settings& settings, Encoded& encoded) {
  const TriangleMesh& decoded = encoded.decoded;
  if (!std::equal(decoded.triangles.begin(), decoded.triangles.end(), mesh.triangles.begin(), mesh.triangles.end()) ||
      decoded.positions.size() != mesh.positions.size() || decoded.normals.size() != mesh.normals.size())
    throw Error(kLocation, "Draco changed the triangles", "the indices of the input");
  const float tolerance = axisTolerance(settings.grid);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 error = glm::abs(decoded.positions[i] - mesh.positions[i]);
    if (std::max({error.x, error.y, error.z}) > tolerance)
      throw Error(kLocation, fmt::format("Draco moved position {} too far", i),
                  fmt::format("at most {} m per axis", tolerance), fmt::format("{}", glm::length(error)));
  }
  encoded.deviation = measureDeviation(mesh, decoded.positions, decoded.normals);
  if (!(encoded.deviation.normalMaxDegrees <= normalTolerance(settings.normalBits)))
    throw Error(kLocation, "Draco rotated a normal too far",
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

// Replaces the sequential encoding by the edgebreaker one if that is smaller and equivalent. Otherwise returns the
// reason.
std::string tryEdgebreaker(const MeshView& mesh, const Settings& settings, const Limits& limits, Encoded& encoded) {
  // Encode.
  const Clock::time_point start = Clock::now();
  std::optional<std::vector<std::byte>> bytes = encodeDraco(Method::kEdgebreaker, mesh, settings);
  const double encodeMs = millisecondsSince(start);
  if (!bytes) return "edgebreaker refuses the mesh";
  if (bytes->size() >= encoded.bytes.size()) return "edgebreaker is not smaller";
  if (std::max(limits.vertices, limits.triangles) > kMaxPerByte * bytes->size())
    return "edgebreaker makes the mesh smaller than a reader trusts";

  // Require the decoded mesh to be a permutation of the sequential result.
  const Clock::time_point decoding = Clock::now();
  TriangleMesh decoded;
  try {
    decoded = decode(*bytes, limits, kLocation);
  } catch (const Error&) {
    return "edgebreaker changes the counts: faces that are degenerate or not manifold, or loose vertices";
  }
  const double decodeMs = millisecondsSince(decoding);
  std::optional<std::vector<std::uint32_t>> vertices = edgebreakerOrder(mesh);
  if (!vertices) return "edgebreaker gives an unknown order of vertices";
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
    if (!isFinite(p)) throw Error(kLocation, "a position is not finite");
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 extent = high - low;
  const float largest = std::max({extent.x, extent.y, extent.z});
  grid.origin = low;
  if (largest > 0 && largest < kMinExtent)
    throw Error(kLocation, "the mesh is too small", fmt::format("an extent of {} or more", kMinExtent),
                fmt::to_string(largest));
  if (largest > 0) grid.range = largest * (1 + 4 * std::numeric_limits<float>::epsilon());
  if (!isFinite(grid.origin + grid.range))
    throw Error(kLocation, "the mesh is too large", "an extent within the range of float");
  return grid;
}

Encoded encode(const MeshView& mesh, const Settings& settings) {
  checkInput(mesh, settings);
  const Limits limits{static_cast<std::uint32_t>(mesh.positions.size()),
                      static_cast<std::uint32_t>(mesh.triangles.size())};

  // Encode sequentially and compare with the input.
  Encoded encoded;
  const Clock::time_point start = Clock::now();
  std::optional<std::vector<std::byte>> bytes = encodeDraco(Method::kSequential, mesh, settings);
  encoded.encodeMs = millisecondsSince(start);
  if (!bytes) throw Error(kLocation, "Draco cannot encode the mesh");
  encoded.bytes = std::move(*bytes);
  encoded.method = "sequential";
  const Clock::time_point decoding = Clock::now();
  encoded.decoded = decode(encoded.bytes, limits, kLocation);
  encoded.decodeMs = millisecondsSince(decoding);
  compareWithSource(mesh, settings, encoded);
  encoded.sourceVertices = identity(mesh.positions.size());
  encoded.sourceTriangles = identity(mesh.triangles.size());

  // Use edgebreaker if it is smaller and equivalent.
  encoded.sequentialReason = tryEdgebreaker(mesh, settings, limits, encoded);
  return encoded;
}

}  // namespace malus::compress
