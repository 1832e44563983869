// Time, memory and size of mesh preparation and packs by number of triangles, from an OBJ file to the first ray. The
// mesh is a bumpy closed surface with normals. No test checks the times.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "meshprep/prepare.h"
#include "render/embree/embree.h"
#include "render/scene/render_scene.h"
#include "tests/bench/torus.h"
#include "tests/largest_memory.h"

namespace malus {
namespace {

namespace fs = std::filesystem;
using bench::preparedTorus;
using bench::torusObj;

pack::Scene makeScene(std::int64_t triangles) {
  const prep::Mesh mesh = preparedTorus(triangles);
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
  // Of the process: run one size at a time.
  state.counters["peakMb"] = static_cast<double>(test::largestMemory()) / (1u << 20u);
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
  const pack::Scene scene = makeScene(state.range(0));
  pack::Written written;
  for ([[maybe_unused]] auto _ : state) written = pack::serialize(scene, {});
  const auto triangles = static_cast<double>(scene.triangleCount());
  state.counters["bytesPerTriangle"] = static_cast<double>(written.meshes[0].sizeBytes) / triangles;
  state.counters["edgebreaker"] = written.meshes[0].method == "edgebreaker" ? 1 : 0;
  state.counters["positionBits"] = written.positionBits;
  state.counters["normalBits"] = written.meshes[0].normalBits;
  state.counters["normalErrorDegrees"] = written.meshes[0].deviation.normalMaxDegrees;
  state.counters["tiltDegrees"] = written.meshes[0].deviation.tiltMaxDegrees;
  state.counters["positionErrorMicrometres"] = 1e6 * written.meshes[0].deviation.positionMax;
  state.counters["encodeMs"] = written.meshes[0].encodeMs;
  state.counters["decodeMs"] = written.meshes[0].decodeMs;
  countMemory(state);
}

// From the bytes of the pack to the RenderScene, without the acceleration structure.
void load(benchmark::State& state) {
  const std::vector<std::byte> bytes = pack::serialize(makeScene(state.range(0)), {}).bytes;
  for ([[maybe_unused]] auto _ : state) {
    const pack::Pack pack = pack::parse(bytes, "bench");
    benchmark::DoNotOptimize(render::makeRenderScene(pack.scene));
  }
  countMemory(state);
}

void accelerate(benchmark::State& state) {
  const render::RenderScene scene = render::makeRenderScene(makeScene(state.range(0)));
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
