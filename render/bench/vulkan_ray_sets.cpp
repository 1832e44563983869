#include "render/bench/vulkan_ray_sets.h"

#include <algorithm>

namespace malus::render {

namespace {

// Traces the rays in parts, so that only one part is stored in the layout of the shader.
vulkan::ReplayTime replayAll(vulkan::RayReplay& replay, VulkanPath path, const embree::RayArrays& rays, bool shadow) {
  const auto& [o, d] = rays;
  vulkan::ReplayTime sum;
  std::vector<vulkan::RecordedRay> part;
  for (std::size_t at = 0; at < rays.size(); at += vulkan::kReplayRays) {
    part.clear();
    for (std::size_t i = at; i < std::min(rays.size(), at + vulkan::kReplayRays); ++i)
      part.push_back({{o[0][i], o[1][i], o[2][i]}, {d[0][i], d[1][i], d[2][i]}});
    const vulkan::ReplayTime time = replay.replay(path, shadow, part);
    sum.ms += time.ms;
    sum.hits += time.hits;
  }
  return sum;
}

}  // namespace

VulkanRaySets::VulkanRaySets(const RaySets& sets, const pack::Scene& scene, const vulkan::Options& options)
    : sets_(sets), replay_(scene, options) {
  for (const RaySets::Set& set : sets.sets()) {
    std::vector<ClassFloor>& classes = classes_.emplace_back();
    for (const RaySets::Class& c : set.classes) {
      ClassFloor& floor = classes.emplace_back();
      floor.kind = c.floor.kind;
      floor.rays = c.floor.rays;
      for (const VulkanPath path : replay_.paths()) floor.calls.emplace_back(vulkanPathName(path), kNotTimed);
    }
  }
}

void VulkanRaySets::replayRound() {
  const std::vector<VulkanPath> paths = replay_.paths();
  for (std::size_t i = 0; i < classes_.size(); ++i)
    for (std::size_t j = 0; j < classes_[i].size(); ++j)
      for (std::size_t p = 0; p < paths.size(); ++p) {
        ClassFloor& floor = classes_[i][j];
        const RaySets::Class& c = sets_.sets()[i].classes[j];
        const vulkan::ReplayTime time = replayAll(replay_, paths[p], c.traced, floor.kind.shadow);
        floor.add(p, time.ms, time.hits);
      }
}

std::vector<RayFloor> VulkanRaySets::floors() const {
  std::vector<RayFloor> floors;
  for (std::size_t i = 0; i < classes_.size(); ++i) floors.push_back({sets_.sets()[i].methods, classes_[i]});
  return floors;
}

}  // namespace malus::render
