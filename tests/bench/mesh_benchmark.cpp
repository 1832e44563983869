// Time, memory and size of mesh preparation and packs, by the number of triangles: a bumpy closed surface with normals,
// from an OBJ file to the first ray. Times are a benchmark's: no test judges them.
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/prepare.h"
#include "render/embree/embree.h"
#include "render/scene/float_scene.h"

namespace malus {
namespace {

namespace fs = std::filesystem;

// A torus of about `triangles` faces with waves on it, so that nothing repeats.
fs::path torusObj(std::int64_t triangles) {
  const fs::path path = fs::temp_directory_path() / fmt::format("malus-bench-{}-{}.obj", ::getpid(), triangles);
  if (fs::exists(path)) return path;
  const auto around = static_cast<std::int64_t>(std::sqrt(static_cast<double>(triangles))), across = around / 2;
  std::string text;
  for (std::int64_t i = 0; i < around; ++i)
    for (std::int64_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(around),
                   v = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(across);
      const double r = 0.4 + 0.02 * std::sin(7 * u + 3 * v);
      text += fmt::format("v {:.7f} {:.7f} {:.7f}\n", (1 + r * std::cos(v)) * std::cos(u), r * std::sin(v),
                          (1 + r * std::cos(v)) * std::sin(u));
    }
  for (std::int64_t i = 0; i < around; ++i)
    for (std::int64_t j = 0; j < across; ++j) {
      const auto at = [&](std::int64_t a, std::int64_t b) { return (a % around) * across + b % across + 1; };
      text += fmt::format("f {} {} {} {}\n", at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

pack::Scene sceneOf(std::int64_t triangles) {
  prep::Report report;
  const prep::Mesh mesh = prep::prepare(torusObj(triangles), {}, report);
  pack::Scene scene;
  scene.name = "bench";
  scene.width = scene.height = 64;
  scene.depth = 4;
  scene.materials.emplace_back();
  pack::Mesh packed;
  packed.name = "torus";
  packed.positions.assign(mesh.positions.begin(), mesh.positions.end());
  packed.normals = mesh.normals;
  packed.triangles = mesh.triangles;
  scene.meshes.push_back(std::move(packed));
  return scene;
}

void countMemory(benchmark::State& state) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  state.counters["peakMb"] = static_cast<double>(usage.ru_maxrss) / 1024;  // of the process so far: run one size alone
}

void prepare(benchmark::State& state) {
  const fs::path file = torusObj(state.range(0));
  std::size_t triangles = 0;
  for ([[maybe_unused]] auto _ : state) {
    prep::Report report;
    triangles = prep::prepare(file, {}, report).triangles.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  countMemory(state);
}

void write(benchmark::State& state) {
  const pack::Scene scene = sceneOf(state.range(0));
  pack::Written written;
  for ([[maybe_unused]] auto _ : state) written = pack::serialize(scene, {});
  const auto triangles = static_cast<double>(scene.triangleCount());
  state.counters["bytesPerTriangle"] = static_cast<double>(written.meshes[0].sizeBytes) / triangles;
  state.counters["edgebreaker"] = written.meshes[0].method == "edgebreaker" ? 1 : 0;
  state.counters["normalErrorDegrees"] = static_cast<double>(written.meshes[0].normalErrorMaxDegrees);
  state.counters["positionErrorMicrometres"] = 1e6 * static_cast<double>(written.meshes[0].positionErrorMax);
  countMemory(state);
}

// From the pack's bytes to what the renderers draw from, the acceleration structure left out.
void load(benchmark::State& state) {
  const std::vector<std::byte> bytes = pack::serialize(sceneOf(state.range(0)), {}).bytes;
  for ([[maybe_unused]] auto _ : state) {
    const pack::Pack pack = pack::parse(bytes, "bench");
    benchmark::DoNotOptimize(render::floatScene(pack.scene));
  }
  countMemory(state);
}

void accelerate(benchmark::State& state) {
  const render::FloatScene scene = render::floatScene(sceneOf(state.range(0)));
  for ([[maybe_unused]] auto _ : state) {
    const embree::Bvh bvh(scene, 0);
    benchmark::DoNotOptimize(bvh.nearest({0, 0, 5}, {0, 0, -1}));
  }
}

#define MALUS_SIZES ->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime()
BENCHMARK(prepare) MALUS_SIZES;
BENCHMARK(write) MALUS_SIZES;
BENCHMARK(load) MALUS_SIZES;
BENCHMARK(accelerate) MALUS_SIZES;

}  // namespace
}  // namespace malus

BENCHMARK_MAIN();
