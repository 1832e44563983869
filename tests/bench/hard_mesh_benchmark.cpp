// Time of the preparation of meshes that are hard for a spatial index or for a triangulation: needles, fans, stars,
// junctions. No test checks the times.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>

#include "meshprep/prepare.h"

namespace malus {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

void addTriangle(prep::Polygons& polygons, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  for (const glm::dvec3& p : {a, b, c}) {
    polygons.corners.push_back(static_cast<std::uint32_t>(polygons.positions.size()));
    polygons.positions.push_back(p);
  }
  polygons.closeFace();
}

// Thin triangles in all directions around a point.
prep::Polygons needles(std::int64_t count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  prep::Polygons polygons;
  for (std::int64_t i = 0; i < count; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 across = 1e-4 * glm::dvec3(normal(random), normal(random), normal(random));
    addTriangle(polygons, 0.01 * d, d, d + across);
  }
  return polygons;
}

// Triangles around a point in a tilted plane, and one whose edge has all their outer vertices on one side.
prep::Polygons junctions(std::int64_t count) {
  prep::Polygons polygons;
  const glm::dvec3 u(0.6, 0.64, 0.48), v(0.8, -0.48, -0.36);
  const auto at = [&](double x, double y) { return x * u + y * v; };
  const auto n = static_cast<double>(count);
  for (std::int64_t i = 0; i < count; ++i)
    addTriangle(polygons, at(static_cast<double>(i) / n, 0), at(static_cast<double>(i + 1) / n, 0), at(0.5, 1));
  addTriangle(polygons, at(1, 0), at(0, 0), at(0.5, -1));
  return polygons;
}

// One face that is a star with this number of corners.
prep::Polygons star(std::int64_t count) {
  prep::Polygons polygons;
  for (std::int64_t i = 0; i < count; ++i) {
    const double angle = kTurn * static_cast<double>(i) / static_cast<double>(count), r = i % 2 == 0 ? 1 : 0.5;
    polygons.corners.push_back(static_cast<std::uint32_t>(i));
    polygons.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  polygons.closeFace();
  return polygons;
}

template <class Make>
void prepareHard(benchmark::State& state, Make make) {
  const prep::Polygons polygons = make(state.range(0));
  prep::Options options;
  options.findIntersections = true;
  std::uint64_t unchecked = 0;
  for ([[maybe_unused]] auto _ : state) {
    prep::Report report;
    benchmark::DoNotOptimize(prep::prepare(polygons, "bench", options, report));
    unchecked = report.count("faces-crossing-unchecked") + report.count("t-junctions-unchecked");
  }
  state.counters["unchecked"] = static_cast<double>(unchecked);
}

void prepareNeedles(benchmark::State& state) { prepareHard(state, needles); }
void prepareJunctions(benchmark::State& state) { prepareHard(state, junctions); }
void prepareStar(benchmark::State& state) { prepareHard(state, star); }

#define MALUS_HARD_SIZES ->Arg(1'000)->Arg(10'000)->Arg(50'000)->Unit(benchmark::kMillisecond)->UseRealTime()
BENCHMARK(prepareNeedles) MALUS_HARD_SIZES;
BENCHMARK(prepareJunctions) MALUS_HARD_SIZES;
BENCHMARK(prepareStar) MALUS_HARD_SIZES;

}  // namespace
}  // namespace malus
