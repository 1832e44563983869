// The logged rays, replayed by a Vulkan device.
#pragma once

#include <vector>

#include "render/bench/ray_sets.h"
#include "render/vulkan/ray_replay.h"

namespace malus::render {

class VulkanRaySets {
 public:
  // sets: must outlive the object and must not change. Throws Error: no usable device.
  VulkanRaySets(const RaySets& sets, const pack::Scene& scene, const vulkan::Options& options);

  // Traces every class of every set once by every path of the device, in the order in which they were logged.
  void replayRound();

  // Of the rounds so far, at least one, in the order of the sets.
  std::vector<RayFloor> floors() const;

 private:
  const RaySets& sets_;
  vulkan::RayReplay replay_;
  std::vector<std::vector<ClassFloor>> classes_;  // of each set: least times by path
};

}  // namespace malus::render
