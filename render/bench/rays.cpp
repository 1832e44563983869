#include "render/bench/rays.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "render/bench/ray_file.h"
#include "render/bench/ray_sets.h"
#include "render/bench/vulkan_ray_sets.h"
#include "render/embree/renderer.h"
#include "render/make_renderer.h"

namespace malus::render {

namespace {

bool has(const RaysBenchSettings& settings, Backend backend) {
  return std::ranges::find(settings.backends, backend) != settings.backends.end();
}

template <class Value>
auto sum(const RayFloor& floor, Value value) {
  decltype(value(ClassFloor())) total = 0;
  for (const ClassFloor& c : floor.classes) total += value(c);
  return total;
}

// The rows of a method, without times.
void addRows(RaysBench& bench, const RaysBenchSettings& settings, const std::string& method, std::size_t floor,
             const std::vector<EmbreePath>& embreePaths, const std::vector<VulkanPath>& vulkanPaths) {
  if (has(settings, Backend::embree))
    for (const EmbreePath path : embreePaths) bench.rows.push_back({method, path, floor});
  for (const VulkanPath path : vulkanPaths) bench.rows.push_back({method, path, floor});
}

void setPath(RenderParameters& parameters, EmbreePath path) { parameters.embreePath = path; }
void setPath(RenderParameters& parameters, VulkanPath path) { parameters.vulkanPath = path; }

// Each round starts with another row, so that a drift of the machine's speed meets every row alike.
void renderRows(embree::Renderer& embree, Renderer* vulkan, const RenderParameters& parameters, RaysBench& bench,
                unsigned round) {
  for (std::size_t i = 0; i < bench.rows.size(); ++i) {
    BenchRow& row = bench.rows[(i + round) % bench.rows.size()];
    console::progress(fmt::format("round {} of {}: {}", round + 1, bench.rounds, row.method));
    Renderer& renderer = vulkan && row.backend() == Backend::vulkan ? *vulkan : embree;
    RenderParameters own = parameters;
    std::visit([&](auto path) { setPath(own, path); }, row.path);
    row.samples.push_back(renderer.render(row.method, own).cost.traceMs);
  }
}

}  // namespace

const std::string& ClassFloor::bestCall() const {
  return std::ranges::min_element(calls, {}, &std::pair<std::string, double>::second)->first;
}
double ClassFloor::ms() const {
  return std::ranges::min_element(calls, {}, &std::pair<std::string, double>::second)->second;
}
void ClassFloor::add(std::size_t i, double ms, std::uint64_t hitsOfCall) {
  calls[i].second = std::min(calls[i].second, ms);
  if (i == 0) hits = hitsOfCall;
}

double RayFloor::ms() const {
  return sum(*this, [](const ClassFloor& c) { return c.ms(); });
}
double RayFloor::singleMs() const {
  return sum(*this, [](const ClassFloor& c) { return c.singleMs(); });
}
std::uint64_t RayFloor::rays() const {
  return sum(*this, [](const ClassFloor& c) { return c.rays; });
}

const char* BenchRow::pathName() const {
  if (const auto* vulkan = std::get_if<VulkanPath>(&path)) return vulkanPathName(*vulkan);
  return embreePathName(std::get<EmbreePath>(path));
}
double BenchRow::totalMs() const { return std::ranges::min(samples); }

RaysBench benchRays(const pack::Scene& scene, const RenderParameters& parameters, const RaysBenchSettings& settings) {
  embree::Renderer renderer(scene, settings.threads);
  RaySets sets(renderer, parameters);
  std::unique_ptr<Renderer> vulkanRenderer;
  if (has(settings, Backend::vulkan))
    vulkanRenderer = makeRenderer(Backend::vulkan, scene, {settings.device, settings.threads});
  RaysBench bench;
  bench.scene = scene.name;
  bench.device = renderer.device();
  bench.width = parameters.width;
  bench.height = parameters.height;
  bench.rounds = settings.rounds;
  for (const std::string& method : settings.methods)
    addRows(bench, settings, method, sets.add(method), renderer.embreePaths(),
            vulkanRenderer ? vulkanRenderer->vulkanPaths() : std::vector<VulkanPath>{});
  std::optional<VulkanRaySets> vulkanSets;
  if (vulkanRenderer) {
    bench.vulkanDevice = vulkanRenderer->device();
    vulkanSets.emplace(sets, scene, vulkan::Options{settings.device, settings.threads});
  }
  if (!settings.rayFile.empty()) writeRays(settings.rayFile, sets.sets().front());
  for (unsigned round = 0; round < settings.rounds; ++round) {
    console::progress(fmt::format("round {} of {}: rays alone", round + 1, settings.rounds));
    if (has(settings, Backend::embree)) sets.replayRound();
    if (vulkanSets) vulkanSets->replayRound();
    renderRows(renderer, vulkanRenderer.get(), parameters, bench, round);
  }
  console::progressDone();
  if (has(settings, Backend::embree)) bench.floors = sets.floors();
  if (vulkanSets) bench.vulkanFloors = vulkanSets->floors();
  return bench;
}

}  // namespace malus::render
