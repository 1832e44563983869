#include "render/bench/rays.h"

#include <algorithm>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "render/bench/ray_sets.h"
#include "render/embree/packets/packets.h"
#include "render/embree/renderer.h"

namespace malus::render {

namespace {

template <class Value>
auto sum(const RayFloor& floor, Value ClassFloor::*member) {
  Value total = 0;
  for (const ClassFloor& c : floor.classes) total += c.*member;
  return total;
}

// Each round starts with another row, so that a drift of the machine's speed meets every row alike.
void renderRows(embree::Renderer& renderer, const RenderParameters& parameters, RaysBench& bench, unsigned round) {
  for (std::size_t i = 0; i < bench.rows.size(); ++i) {
    BenchRow& row = bench.rows[(i + round) % bench.rows.size()];
    RenderParameters own = parameters;
    own.embreePath = row.path;
    console::progress(fmt::format("round {} of {}: {}", round + 1, bench.rounds, row.method));
    row.samples.push_back(renderer.render(row.method, own).cost.traceMs);
  }
}

}  // namespace

double RayFloor::ms() const { return sum(*this, &ClassFloor::ms); }
double RayFloor::singleMs() const { return sum(*this, &ClassFloor::singleMs); }
std::uint64_t RayFloor::rays() const { return sum(*this, &ClassFloor::rays); }

double BenchRow::totalMs() const { return std::ranges::min(samples); }

RaysBench benchRays(const pack::Scene& scene, const RenderParameters& parameters, const RaysBenchSettings& settings) {
  embree::Renderer renderer(scene, settings.threads);
  RaySets sets(renderer, parameters);
  RaysBench bench;
  bench.scene = scene.name;
  bench.device = renderer.device();
  bench.width = parameters.width;
  bench.height = parameters.height;
  bench.rounds = settings.rounds;
  for (const std::string& method : settings.methods) {
    const std::size_t floor = sets.add(method);
    if (embree::hasPacketInstructions()) bench.rows.push_back({method, EmbreePath::packet, floor, {}});
    bench.rows.push_back({method, EmbreePath::scalar, floor, {}});
  }
  for (unsigned round = 0; round < settings.rounds; ++round) {
    console::progress(fmt::format("round {} of {}: rays alone", round + 1, settings.rounds));
    sets.replayRound();
    renderRows(renderer, parameters, bench, round);
  }
  console::progressDone();
  bench.floors = sets.floors();
  return bench;
}

}  // namespace malus::render
