// Boundary loops and crease normals by meshprep's edge list and by OpenMesh's half-edge structure, on the same clean
// torus, and the conversion required by the half-edge structure. Two strips of the torus are removed to create
// boundaries.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "meshprep/clean/holes.h"
#include "meshprep/clean/select.h"
#include "meshprep/halfedge/half_edge_mesh.h"
#include "meshprep/normals/crease_normals.h"
#include "tests/bench/torus.h"

namespace malus {
namespace {

constexpr double kCreaseDegrees = 40;

prep::Mesh openTorus(std::int64_t triangles) {
  prep::Options options;
  options.flat = true;
  prep::Report report;
  prep::Mesh mesh = prep::prepare(bench::torusObj(triangles), options, report);
  const auto strip = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles)));
  const std::size_t half = mesh.triangles.size() / 2;
  prep::keepTriangles(mesh, [&](std::size_t i) { return i >= strip && (i < half || i >= half + strip); });
  return mesh;
}

void convertToHalfEdges(benchmark::State& state) {
  const prep::Mesh mesh = openTorus(state.range(0));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(prep::toHalfEdges(mesh).n_faces());
}

void loopsByEdgeList(benchmark::State& state) {
  const prep::Mesh mesh = openTorus(state.range(0));
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(prep::findHoles(prep::edgeUses(mesh.triangles)).size());
}

// Without the conversion.
void loopsByHalfEdges(benchmark::State& state) {
  const prep::Mesh mesh = openTorus(state.range(0));
  const prep::HalfEdgeMesh halfEdges = prep::toHalfEdges(mesh);
  for ([[maybe_unused]] auto _ : state) {
    std::vector<char> isVisited(halfEdges.n_halfedges(), 0);
    std::size_t loops = 0;
    for (const OpenMesh::HalfedgeHandle start : halfEdges.halfedges()) {
      if (!halfEdges.is_boundary(start) || isVisited[static_cast<std::size_t>(start.idx())] != 0) continue;
      for (OpenMesh::HalfedgeHandle h = start; isVisited[static_cast<std::size_t>(h.idx())] == 0;
           h = halfEdges.next_halfedge_handle(h))
        isVisited[static_cast<std::size_t>(h.idx())] = 1;
      ++loops;
    }
    benchmark::DoNotOptimize(loops);
  }
}

void normalsByEdgeList(benchmark::State& state) {
  const prep::Mesh mesh = openTorus(state.range(0));
  for ([[maybe_unused]] auto _ : state) {
    prep::Mesh copy = mesh;
    benchmark::DoNotOptimize(prep::addCreaseNormals(copy, kCreaseDegrees));
  }
}

// Without the conversion, and without the vertices that creases need; the weights are not those of the angles.
void normalsByHalfEdges(benchmark::State& state) {
  const prep::Mesh mesh = openTorus(state.range(0));
  prep::HalfEdgeMesh halfEdges = prep::toHalfEdges(mesh);
  halfEdges.request_face_normals();
  halfEdges.request_halfedge_normals();
  for ([[maybe_unused]] auto _ : state) {
    halfEdges.update_face_normals();
    halfEdges.update_halfedge_normals(kCreaseDegrees * 3.14159265358979 / 180);
  }
}

#define MALUS_SIZES ->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)
BENCHMARK(convertToHalfEdges) MALUS_SIZES;
BENCHMARK(loopsByEdgeList) MALUS_SIZES;
BENCHMARK(loopsByHalfEdges) MALUS_SIZES;
BENCHMARK(normalsByEdgeList) MALUS_SIZES;
BENCHMARK(normalsByHalfEdges) MALUS_SIZES;

}  // namespace
}  // namespace malus
