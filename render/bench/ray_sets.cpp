#include "render/bench/ray_sets.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"

namespace malus::render {

namespace {
constexpr double kBytesPerRay = 2 * 6 * sizeof(float);  // in two orders
}  // namespace

RaySets::RaySets(embree::Renderer& renderer, const RenderParameters& parameters)
    : renderer_(renderer), parameters_(parameters), calls_(embree::rayCalls(renderer.bvh())) {}

void RaySets::requireMemory(std::uint64_t rays) const {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const double needed = static_cast<double>(stored_ + rays) * kBytesPerRay;
  if (needed > memory / 2)
    throw Error("bench rays", fmt::format("{} rays do not fit into the memory", stored_ + rays),
                fmt::format("at most {:.1f} GB, half of the memory; give a smaller --width", memory / 2e9),
                fmt::format("{:.1f} GB", needed / 1e9));
}

std::size_t RaySets::add(const std::string& method) {
  console::progress(fmt::format("logging the rays of {}", method));
  requireMemory(renderer_.render(method, parameters_).cost.rays);
  embree::RayLog log = renderer_.logRays(method, parameters_);
  for (std::size_t i = 0; i < sets_.size(); ++i)
    if (std::ranges::equal(sets_[i].classes, log, [](const Class& stored, const auto& logged) {
          return stored.floor.kind == logged.first && stored.traced == logged.second;
        })) {
      sets_[i].methods.push_back(method);
      return i;
    }
  stored_ += embree::countRays(log);
  Set& set = sets_.emplace_back();
  set.methods = {method};
  for (auto& [kind, rays] : log) {
    Class& c = set.classes.emplace_back();
    c.floor.kind = kind;
    c.floor.rays = rays.size();
    for (const embree::RayCall& call : calls_) c.floor.calls.emplace_back(call.name(), kNotTimed);
    c.sorted = embree::sortRays(rays);
    c.traced = std::move(rays);
  }
  return sets_.size() - 1;
}

void RaySets::replayRound() {
  for (Set& set : sets_)
    for (Class& c : set.classes)
      for (std::size_t i = 0; i < calls_.size(); ++i) {
        const embree::RayArrays& rays = calls_[i].sorted ? c.sorted : c.traced;
        const embree::ReplayResult result =
            embree::replay(renderer_.bvh(), rays, c.floor.kind.shadow, calls_[i], renderer_.threads());
        c.floor.add(i, result.ms, result.hits);
      }
}

std::vector<RayFloor> RaySets::floors() const {
  std::vector<RayFloor> floors;
  for (const Set& set : sets_) {
    RayFloor& floor = floors.emplace_back();
    floor.methods = set.methods;
    for (const Class& c : set.classes) floor.classes.push_back(c.floor);
  }
  return floors;
}

}  // namespace malus::render
