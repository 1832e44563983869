// The choice of how the rays of a method are traced on a device.
#pragma once

#include <string>
#include <vector>

#include "render/scene/methods.h"
#include "render/vulkan/device.h"
#include "render/vulkan/variant.h"

namespace malus::vulkan {

struct TracingChoice {
  Tracing tracing = Tracing::recursion;
  std::string withoutRecursion;  // reason if a recursive method cannot recurse; else empty
};

// By parameters.vulkanPath. automatic: recursion where the device's limit allows the depth; else ray queries where the
// device has them; else hit records. Throws Error: ray queries are asked for and the device lacks them.
// Shadow rays that pass surfaces need hits, which recursion has not.
TracingChoice chooseTracing(const Device& device, const render::MethodInfo& method, const pack::Scene& scene,
                            const render::RenderParameters& parameters);

// The paths of a device, the one that an iterative method takes automatically first.
std::vector<render::VulkanPath> availablePaths(const Device& device);

render::VulkanPath vulkanPath(Tracing tracing);

}  // namespace malus::vulkan
