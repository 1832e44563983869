// Encoding with verification. The sequential result is compared with the input, the edgebreaker result with the
// sequential one, which has the same quantized values.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "meshprep/base/error.h"
#include "meshprep/compress/deviation.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/compress/draco_write.h"
#include "meshprep/compress/grid_rounding.h"
#include "meshprep/compress/reordering.h"

namespace malus::compress {

namespace {

constexpr std::string_view kLocation = "mesh to compress";

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Returns an upper bound of the error of octahedral quantization in degrees: twice the measured 0.90 degrees at 8 bits,
// halved by each further bit, and 0.05 degrees for rounding to float.
double normalTolerance(int normalBits) { return 2.0 * 0.9 * std::pow(2.0, 8 - normalBits) + 0.05; }

void checkInput(const MeshView& mesh, const Settings& settings) {
  // Check the settings.
  requireValid(settings.grid, kLocation);
  if (settings.normalBits < kMinNormalBits || settings.normalBits > kMaxNormalBits)
    throw Error(kLocation, "number of normal bits out of range",
                fmt::format("{} to {}", kMinNormalBits, kMaxNormalBits), fmt::to_string(settings.normalBits));

  // Check the sizes.
  if (mesh.positions.empty() || mesh.triangles.empty()) throw Error(kLocation, "the mesh is empty");
  if (mesh.positions.size() > kMaxTriangles || mesh.triangles.size() > kMaxTriangles)
    throw Error(kLocation, "too many vertices or triangles", fmt::format("at most {}", kMaxTriangles));
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
    throw Error(kLocation, "wrong number of normals", fmt::to_string(mesh.positions.size()),
                fmt::to_string(mesh.normals.size()));

  // Check the values.
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

// Returns the integers of positions on the grid. Throws Error if one is not on it.
std::vector<glm::ivec3> gridIntegers(std::span<const glm::dvec3> rounded, const Grid& grid) {
  const double most = std::ldexp(1.0, grid.positionBits) - 1;
  std::vector<glm::ivec3> integers;
  integers.reserve(rounded.size());
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    const glm::dvec3 p = rounded[i];
    if (!isFinite(p)) throw Error(kLocation, fmt::format("position {} is not finite", i));
    const glm::dvec3 k = (p - grid.origin) / grid.step;
    if (k != glm::round(k) || glm::any(glm::lessThan(k, glm::dvec3(0))) ||
        glm::any(glm::greaterThan(k, glm::dvec3(most))))
      throw Error(kLocation, fmt::format("position {} is outside of the grid", i),
                  fmt::format("0 to {} steps of {:g} m from ({:g}, {:g}, {:g})", most, grid.step, grid.origin.x,
                              grid.origin.y, grid.origin.z),
                  fmt::format("({:.17g}, {:.17g}, {:.17g})", p.x, p.y, p.z));
    integers.emplace_back(k);
  }
  return integers;
}

// Requires the decoded attributes of textures to be the rounded ones.
void compareTextures(const RoundedTextures& textures, const TriangleMesh& decoded) {
  bool isEqual = decoded.tangents.size() == textures.tangents.size();
  for (std::size_t i = 0; isEqual && i < textures.tangents.size(); ++i)
    isEqual = decoded.tangents[i] == decodedTangent(textures.tangents[i], textures.grids.tangentBits);
  for (std::size_t set = 0; set < textures.coordinates.size(); ++set) {
    const std::vector<glm::ivec2>& integers = textures.coordinates[set];
    const std::vector<glm::vec2>& found = decoded.textureCoordinates[set];
    isEqual = isEqual && found.size() == integers.size();
    for (std::size_t i = 0; isEqual && i < integers.size(); ++i)
      isEqual = found[i] == decodedCoordinate(textures.grids.sets[set], integers[i]);
  }
  if (!isEqual) throw Error(kLocation, "Draco changed texture coordinates or tangents", "the integers of the input");
}

// Requires the sequential result to have the triangles and the rounded positions of the input, and measures it.
void compareWithSource(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Settings& settings,
                       const RoundedTextures& textures, Encoded& encoded) {
  const TriangleMesh& decoded = encoded.decoded;
  if (!std::equal(decoded.triangles.begin(), decoded.triangles.end(), mesh.triangles.begin(), mesh.triangles.end()) ||
      decoded.positions.size() != mesh.positions.size() || decoded.normals.size() != mesh.normals.size())
    throw Error(kLocation, "Draco changed the triangles", "the indices of the input");
  for (std::size_t i = 0; i < rounded.size(); ++i)
    if (decoded.positions[i] != rounded[i])
      throw Error(kLocation, fmt::format("Draco moved position {}", i), "the integers of the input",
                  fmt::format("{:g} m", glm::distance(decoded.positions[i], rounded[i])));
  compareTextures(textures, decoded);
  encoded.deviation = measureDeviation(mesh, decoded.positions, decoded.normals, settings.leastCross);
  if (!(encoded.deviation.normalMaxDegrees <= normalTolerance(settings.normalBits)))
    throw Error(kLocation, "Draco rotated a normal too far",
                fmt::format("at most {} degrees", normalTolerance(settings.normalBits)),
                fmt::format("{}", encoded.deviation.normalMaxDegrees));
}

// Processor time of the calling thread: the encodings run at the same time.
double threadMs() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

std::vector<std::uint32_t> identity(std::size_t size) {
  std::vector<std::uint32_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

// Encodes sequentially and compares with the input.
Encoded encodeSequentially(const MeshView& mesh, std::span<const glm::dvec3> rounded,
                           std::span<const glm::ivec3> integers, const Settings& settings,
                           const RoundedTextures& textures, const Limits& limits) {
  Encoded encoded;
  const double start = threadMs();
  std::optional<std::vector<std::byte>> bytes =
      encodeDraco(Method::kSequential, mesh, integers, settings.normalBits, textures);
  encoded.encodeMs = threadMs() - start;
  if (!bytes) throw Error(kLocation, "Draco cannot encode the mesh");
  encoded.bytes = std::move(*bytes);
  encoded.method = "sequential";
  const double decoding = threadMs();
  encoded.decoded = decode(encoded.bytes, limits, settings.grid, kLocation, textures.grids);
  encoded.decodeMs = threadMs() - decoding;
  compareWithSource(mesh, rounded, settings, textures, encoded);
  return encoded;
}

// The edgebreaker encoding; without bytes or mesh where Draco refuses.
struct Edgebreaker {
  std::optional<std::vector<std::byte>> bytes;
  std::optional<TriangleMesh> decoded;
  double encodeMs = 0, decodeMs = 0;
};

Edgebreaker encodeByEdgebreaker(const MeshView& mesh, std::span<const glm::ivec3> integers, const Settings& settings,
                                const RoundedTextures& textures, const Limits& limits) {
  Edgebreaker result;
  const double start = threadMs();
  result.bytes = encodeDraco(Method::kEdgebreaker, mesh, integers, settings.normalBits, textures);
  result.encodeMs = threadMs() - start;
  if (!result.bytes) return result;
  const double decoding = threadMs();
  try {
    result.decoded = decode(*result.bytes, limits, settings.grid, kLocation, textures.grids);
  } catch (const Error&) {  // see preferEdgebreaker
  }
  result.decodeMs = threadMs() - decoding;
  return result;
}

// Replaces the sequential encoding by the edgebreaker one if that is smaller and equivalent: the decoded mesh is a
// permutation of the sequential result. Otherwise returns the reason.
std::string preferEdgebreaker(Edgebreaker&& candidate, const MeshView& mesh, std::span<const glm::ivec3> integers,
                              const RoundedTextures& textures, const Limits& limits, Encoded& encoded) {
  auto& [bytes, decoded, encodeMs, decodeMs] = candidate;
  if (!bytes) return "edgebreaker refuses the mesh";
  if (bytes->size() >= encoded.bytes.size()) return "edgebreaker is not smaller";
  if (std::max(limits.vertices, limits.triangles) > kMaxPerByte * bytes->size())
    return "edgebreaker makes the mesh smaller than a reader trusts";
  if (!decoded) return "edgebreaker changes the counts: faces that are degenerate or not manifold, or loose vertices";
  std::optional<std::vector<std::uint32_t>> vertices = matchVertices(encoded.decoded, *decoded);
  if (!vertices) vertices = edgebreakerOrder(mesh, integers, textures);  // several vertices have equal values
  if (!vertices) return "edgebreaker gives an unknown order of vertices";
  std::optional<std::vector<std::uint32_t>> triangles = sourceTriangles(encoded.decoded, *decoded, *vertices);
  if (!triangles) return "edgebreaker changes the triangles";

  encoded.bytes = std::move(*bytes);
  encoded.method = "edgebreaker";
  encoded.decoded = std::move(*decoded);
  encoded.sourceVertices = std::move(*vertices);
  encoded.sourceTriangles = std::move(*triangles);
  encoded.encodeMs = encodeMs;
  encoded.decodeMs = decodeMs;
  return {};
}

}  // namespace

void requireValid(const Grid& grid, std::string_view where) {
  if (grid.positionBits < 1 || grid.positionBits > kMaxPositionBits)
    throw Error(where, "number of position bits out of range", fmt::format("1 to {}", kMaxPositionBits),
                fmt::to_string(grid.positionBits));
  int exponent = 0;
  if (!(grid.step > 0) || !std::isfinite(grid.step) || std::frexp(grid.step, &exponent) != 0.5)
    throw Error(where, "invalid grid", "a step that is a power of two", fmt::format("{:.17g} m", grid.step));
  const glm::dvec3 steps = grid.origin / grid.step;
  if (!isFinite(grid.origin) || steps != glm::round(steps) ||
      glm::any(glm::greaterThan(glm::abs(steps), glm::dvec3(kMaxSteps))))
    throw Error(where, "invalid grid", fmt::format("an origin of a whole number of steps, at most {:g}", kMaxSteps),
                fmt::format("({:.17g}, {:.17g}, {:.17g}) m with steps of {:g} m", grid.origin.x, grid.origin.y,
                            grid.origin.z, grid.step));
}

void requireAcceptedSize(std::span<const glm::dvec3> positions, std::string_view where) {
  for (const glm::dvec3& p : positions)
    if (!isFinite(p)) throw Error(where, "a position is not finite");
  if (positions.empty()) return;
  const Extent extent = findExtent(positions);
  const double size = extent.largest(), farthest = extent.farthest();
  if (!(size == 0 || size >= kMinExtent))
    throw Error(where, "the mesh is too small", fmt::format("a size of {:g} to {:g} m", kMinExtent, kMaxExtent),
                fmt::format("{:g} m", size));
  if (!(size <= kMaxExtent) || (size == 0 && farthest > kMaxExtent))
    throw Error(where, "the mesh is too large", fmt::format("a size of {:g} to {:g} m", kMinExtent, kMaxExtent),
                fmt::format("{:g} m", std::max(size, farthest)));
  if (size > 0 && farthest > kMaxDistance * size)
    throw Error(where, "the mesh is too far from the origin of its coordinates, which double cannot resolve",
                fmt::format("a distance of at most {:g} times its size of {:g} m", kMaxDistance, size),
                fmt::format("{:g} m", farthest));
}

Grid gridWithStep(std::span<const glm::dvec3> positions, double step) {
  Grid grid;
  grid.step = step;
  grid.positionBits = 1;
  if (positions.empty()) return grid;
  const Extent extent = findExtent(positions);
  grid.origin = extent.low;
  const double most = extent.largest() / step;
  if (most >= 1) grid.positionBits = std::ilogb(most) + 1;
  return grid;
}

Grid gridFor(std::span<const glm::dvec3> positions, int positionBits, std::string_view where) {
  requireAcceptedSize(positions, where);
  if (positions.empty()) return {glm::dvec3(0), 1, positionBits};
  Grid grid;
  grid.step = std::ldexp(1.0, stepExponent(positions, positionBits));
  grid.origin = roundToStep(findExtent(positions).low, grid.step);
  grid.positionBits = positionBits;
  return grid;
}

Encoded encode(const MeshView& mesh, const Settings& settings) {
  return encode(mesh, roundPositions(mesh.positions, settings.grid.step), settings);
}

Encoded encode(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Settings& settings,
               const RoundedTextures& textures) {
  checkInput(mesh, settings);
  requireValid(textures.grids, kLocation);
  for (const std::size_t size :
       {textures.coordinates[0].size(), textures.coordinates[1].size(), textures.tangents.size()})
    if (size != 0 && size != mesh.positions.size())
      throw Error(kLocation, "wrong number of texture coordinates or tangents", fmt::to_string(mesh.positions.size()),
                  fmt::to_string(size));
  if (rounded.size() != mesh.positions.size()) throw Error(kLocation, "wrong number of rounded positions");
  const std::vector<glm::ivec3> integers = gridIntegers(rounded, settings.grid);
  const Limits limits{static_cast<std::uint32_t>(mesh.positions.size()),
                      static_cast<std::uint32_t>(mesh.triangles.size())};

  Encoded encoded;
  Edgebreaker candidate;
  oneapi::tbb::parallel_invoke(
      [&] { encoded = encodeSequentially(mesh, rounded, integers, settings, textures, limits); },
      [&] { candidate = encodeByEdgebreaker(mesh, integers, settings, textures, limits); });
  encoded.sequentialReason = preferEdgebreaker(std::move(candidate), mesh, integers, textures, limits, encoded);
  if (!encoded.sequentialReason.empty()) {
    encoded.sourceVertices = identity(mesh.positions.size());
    encoded.sourceTriangles = identity(mesh.triangles.size());
  }
  return encoded;
}

}  // namespace malus::compress
