// Encoding with verification: the result of decoding is compared with the integers and normals of the input.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
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
#include "meshprep/compress/draco_read.h"
#include "meshprep/compress/draco_write.h"
#include "meshprep/compress/grid_rounding.h"
#include "meshprep/compress/reordering.h"

namespace malus::compress {

namespace {

constexpr std::string_view kLocation = "mesh to compress";

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

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

// Processor time of the calling thread: meshes may be encoded at the same time.
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

// Returns the source vertex of each decoded vertex, or nothing if Draco's order is not a permutation.
std::optional<std::vector<std::uint32_t>> sourceVertices(std::span<const std::uint32_t> vertexOfValue,
                                                         const draco::Mesh& decoded) {
  const draco::PointAttribute& values = *decoded.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  std::vector<std::uint32_t> vertices(decoded.num_points());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t value = values.mapped_index(draco::PointIndex(i)).value();
    if (value >= vertexOfValue.size()) return std::nullopt;
    vertices[i] = vertexOfValue[value];
  }
  if (!isPermutation(vertices)) return std::nullopt;
  return vertices;
}

}  // namespace

struct Encoder::Input {
  std::unique_ptr<draco::Mesh> mesh;
  Limits limits;
  Settings settings;
  TextureGrids textures;

  // Decodes and compares with the input. Returns the reason if the bytes are not equivalent, and the map if they are.
  std::string verify(const DracoBytes& candidate, Encoded& result) const {
    const double start = threadMs();
    draco::Mesh decoded;
    try {
      readDraco(candidate.bytes, limits, draco::DT_INT32, textures, kLocation, decoded);
    } catch (const Error&) {
      return "changes the counts: faces that are degenerate or not manifold, or loose vertices";
    }
    result.decodeMs = threadMs() - start;
    std::optional<std::vector<std::uint32_t>> vertices = sourceVertices(candidate.vertexOfValue, decoded);
    if (!vertices) return "gives an unknown order of vertices";
    if (!haveEqualValues(*mesh, decoded, *vertices, settings.normalBits)) return "changes the values";
    std::optional<std::vector<std::uint32_t>> triangles = matchTriangles(faces(*mesh), faces(decoded), *vertices);
    if (!triangles) return "changes the triangles";
    result.sourceVertices = std::move(*vertices);
    result.sourceTriangles = std::move(*triangles);
    return {};
  }

  // Encodes by edgebreaker. Returns the reason if the result is not equivalent or not smaller. sequential: encodes
  // sequentially, once.
  std::string tryEdgebreaker(const std::function<const DracoBytes&()>& sequential, Encoded& result) const {
    const double start = threadMs();
    std::optional<DracoBytes> candidate = writeDraco(Method::kEdgebreaker, *mesh, settings.normalBits);
    result.encodeMs = threadMs() - start;
    if (!candidate) return "edgebreaker refuses the mesh";
    const std::size_t size = candidate->bytes.size();
    if (size >= leastSequentialBytes(*mesh) && size >= sequential().bytes.size()) return "edgebreaker is not smaller";
    if (std::max(limits.vertices, limits.triangles) > kMaxPerByte * size)
      return "edgebreaker makes the mesh smaller than a reader trusts";
    if (const std::string reason = verify(*candidate, result); !reason.empty()) return "edgebreaker " + reason;
    result.method = "edgebreaker";
    result.bytes = std::move(candidate->bytes);
    return {};
  }
};

Encoder::Encoder(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Settings& settings,
                 const RoundedTextures& textures) {
  checkInput(mesh, settings);
  requireValid(textures.grids, kLocation);
  for (const std::size_t size :
       {textures.coordinates[0].size(), textures.coordinates[1].size(), textures.tangents.size()})
    if (size != 0 && size != mesh.positions.size())
      throw Error(kLocation, "wrong number of texture coordinates or tangents", fmt::to_string(mesh.positions.size()),
                  fmt::to_string(size));
  if (rounded.size() != mesh.positions.size()) throw Error(kLocation, "wrong number of rounded positions");
  const Limits limits{static_cast<std::uint32_t>(mesh.positions.size()),
                      static_cast<std::uint32_t>(mesh.triangles.size())};
  input_ = std::make_unique<Input>(
      Input{makeDracoMesh(mesh, rounded, settings.grid, textures), limits, settings, textures.grids});
  deviation_ = measureDeviation(mesh, rounded, roundNormals(mesh.normals, settings.normalBits), settings.leastCross);
}

Encoder::~Encoder() = default;

Encoded Encoder::encode() const {
  std::optional<DracoBytes> sequential;
  double sequentialMs = 0;
  const auto encodeSequentially = [&]() -> const DracoBytes& {
    if (sequential) return *sequential;
    const double start = threadMs();
    sequential = writeDraco(Method::kSequential, *input_->mesh, input_->settings.normalBits);
    sequentialMs = threadMs() - start;
    if (!sequential) throw Error(kLocation, "Draco cannot encode the mesh");
    return *sequential;
  };
  Encoded result;
  result.deviation = deviation_;
  result.sequentialReason = input_->tryEdgebreaker(encodeSequentially, result);
  if (result.sequentialReason.empty()) return result;

  // Use the sequential encoding, which keeps all orders.
  encodeSequentially();
  sequential->vertexOfValue = identity(input_->limits.vertices);
  result.encodeMs = sequentialMs;
  if (const std::string reason = input_->verify(*sequential, result); !reason.empty())
    throw Error(kLocation, "Draco's sequential encoding " + reason, "the values of the input");
  if (result.sourceTriangles != identity(input_->limits.triangles))
    throw Error(kLocation, "Draco changed the order of the triangles", "that of the input");
  result.method = "sequential";
  result.bytes = std::move(sequential->bytes);
  return result;
}

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
  grid.step = std::ldexp(1.0, stepExponent(findExtent(positions), positionBits));
  grid.origin = roundToStep(findExtent(positions).low, grid.step);
  grid.positionBits = positionBits;
  return grid;
}

Encoded encode(const MeshView& mesh, const Settings& settings) {
  return encode(mesh, roundPositions(mesh.positions, settings.grid.step), settings);
}

Encoded encode(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Settings& settings,
               const RoundedTextures& textures) {
  return Encoder(mesh, rounded, settings, textures).encode();
}

}  // namespace malus::compress
