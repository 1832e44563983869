// The same mesh with other formats: a binary PLY file, draco_encoder and gltfpack, if they are installed. Sizes are
// bytes per triangle of the whole file; times are those of the whole command, including file access.
//
// Errors of draco_encoder, which may reorder vertices, are distances of each source vertex to the nearest decoded
// vertex. Errors of gltfpack are computed from its documented quantization, half a step of 2^N - 1 over the largest
// extent along each axis; its results are not read back.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <unordered_map>
#include <vector>

#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/atomic_file.h"
#include "tests/bench/torus.h"

namespace malus {
namespace {

namespace fs = std::filesystem;

// A temporary file, removed by the destructor.
struct Scratch {
  fs::path path;
  explicit Scratch(std::string_view extension)
      : path(fs::temp_directory_path() / fmt::format("malus-bench-{}{}", ::getpid(), extension)) {}
  ~Scratch() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

std::string plyText(const prep::Mesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  const auto append = [&](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) append(glm::vec3(mesh.positions[i])), append(mesh.normals[i]);
  for (const glm::uvec3& t : mesh.triangles) append(std::uint8_t{3}), append(t);
  return text;
}

std::string objText(const prep::Mesh& mesh) {
  std::string text;
  for (const glm::dvec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const glm::vec3& n : mesh.normals) text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
  for (const glm::uvec3& t : mesh.triangles)
    text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

bool isInstalled(const std::string& program) {
  return std::system(fmt::format("command -v {} > /dev/null 2>&1", program).c_str()) == 0;
}

double bytesPerTriangle(const fs::path& file, const prep::Mesh& mesh) {
  return static_cast<double>(fs::file_size(file)) / static_cast<double>(mesh.triangles.size());
}

std::vector<glm::vec3> decodedPositions(const fs::path& file) {
  const std::vector<std::byte> bytes = readFile(file);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  const auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  std::vector<glm::vec3> positions;
  if (!mesh.ok()) return positions;
  const draco::PointAttribute* attribute = mesh.value()->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  positions.resize(mesh.value()->num_points());
  for (std::uint32_t i = 0; i < positions.size(); ++i)
    attribute->GetValue(attribute->mapped_index(draco::PointIndex(i)), &positions[i]);
  return positions;
}

// Returns the largest distance of a source vertex to the nearest of `points` if it is below `cell`, otherwise infinity.
double farthest(const std::vector<glm::dvec3>& sources, const std::vector<glm::vec3>& points, double cell) {
  const auto key = [](const glm::dvec3& c) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(c.x) * 73856093 ^
                                      static_cast<std::int64_t>(c.y) * 19349663 ^
                                      static_cast<std::int64_t>(c.z) * 83492791);
  };
  std::unordered_multimap<std::uint64_t, std::size_t> cells;
  for (std::size_t i = 0; i < points.size(); ++i) cells.emplace(key(glm::floor(glm::dvec3(points[i]) / cell)), i);
  double largest = 0;
  for (const glm::dvec3& p : sources) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 27; ++n) {
      const glm::dvec3 neighbour(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const auto [first, last] = cells.equal_range(key(glm::floor(p / cell) + neighbour));
      for (auto at = first; at != last; ++at)
        nearest = std::min(nearest, glm::distance(p, glm::dvec3(points[at->second])));
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

double largestExtent(const prep::Mesh& mesh) {
  glm::dvec3 low = mesh.positions[0], high = low;
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

void plainPly(benchmark::State& state) {
  const prep::Mesh mesh = bench::preparedTorus(state.range(0));
  const Scratch ply(".ply");
  for ([[maybe_unused]] auto _ : state) write(ply.path, plyText(mesh));
  state.counters["bytesPerTriangle"] = bytesPerTriangle(ply.path, mesh);
}

// Compression level 7, positions of 20 bits, normals of 13 bits, as chosen by malus for this mesh.
void dracoEncoder(benchmark::State& state) {
  if (!isInstalled("draco_encoder")) return state.SkipWithError("draco_encoder is not installed");
  const prep::Mesh mesh = bench::preparedTorus(state.range(0));
  const Scratch ply(".ply"), drc(".drc");
  write(ply.path, plyText(mesh));
  const std::string command = fmt::format("draco_encoder -i {} -o {} -cl 7 -qp 20 -qn 13 > /dev/null 2>&1",
                                          ply.path.string(), drc.path.string());
  for ([[maybe_unused]] auto _ : state)
    if (std::system(command.c_str()) != 0) return state.SkipWithError("draco_encoder failed");
  const std::vector<glm::vec3> decoded = decodedPositions(drc.path);
  state.counters["bytesPerTriangle"] = bytesPerTriangle(drc.path, mesh);
  state.counters["vertices"] = static_cast<double>(decoded.size());
  state.counters["positionErrorMicrometres"] = 1e6 * farthest(mesh.positions, decoded, 1e-5 * largestExtent(mesh));
}

// bits: of positions; options: command line options that select them.
void gltfpack(benchmark::State& state, int bits, const std::string& options) {
  if (!isInstalled("gltfpack")) return state.SkipWithError("gltfpack is not installed");
  const prep::Mesh mesh = bench::preparedTorus(state.range(0));
  const Scratch obj(".packed.obj"), glb(".glb");
  write(obj.path, objText(mesh));
  const std::string command =
      fmt::format("gltfpack -i {} -o {} -cc {} > /dev/null 2>&1", obj.path.string(), glb.path.string(), options);
  for ([[maybe_unused]] auto _ : state)
    if (std::system(command.c_str()) != 0) return state.SkipWithError("gltfpack failed");
  state.counters["bytesPerTriangle"] = bytesPerTriangle(glb.path, mesh);
  state.counters["computedErrorMicrometres"] =
      1e6 * std::sqrt(3.0) / 2 * largestExtent(mesh) / (std::pow(2.0, bits) - 1);
}
void gltfpackDefault(benchmark::State& state) { gltfpack(state, 14, ""); }
void gltfpackFinest(benchmark::State& state) { gltfpack(state, 16, "-vp 16 -vn 16"); }

#define MALUS_SIZES ->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime()
BENCHMARK(plainPly) MALUS_SIZES;
BENCHMARK(dracoEncoder) MALUS_SIZES;
BENCHMARK(gltfpackDefault) MALUS_SIZES;
BENCHMARK(gltfpackFinest) MALUS_SIZES;

}  // namespace
}  // namespace malus
