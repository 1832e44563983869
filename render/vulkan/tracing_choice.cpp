#include "render/vulkan/tracing_choice.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/scene/compiled_effects.h"
#include "render/vulkan/pipeline.h"

namespace malus::vulkan {

using render::VulkanPath;

namespace {

void requireRayQueries(const Device& device) {
  if (device.capabilities().rayQuery) return;
  const bool hasExtension = device.capabilities().has(VK_KHR_RAY_QUERY_EXTENSION_NAME);
  throw Error("--vulkan-path",
              fmt::format("device '{}' lacks ray queries (missing {})", device.physical().name,
                          hasExtension ? "feature rayQuery" : "extension " VK_KHR_RAY_QUERY_EXTENSION_NAME),
              "pipeline, another device (--device) or --backend embree", "query");
}

// Reason why a recursive method cannot recurse; empty: it can.
std::string findRecursionProblem(const Device& device, const render::RenderParameters& parameters) {
  const std::uint64_t needed = requiredRecursion(Tracing::recursion, parameters.depth),
                      limit = device.capabilities().maxRayRecursionDepth;
  if (needed > limit)
    return fmt::format("depth {} needs {} nested rays; device '{}' allows {}", parameters.depth, needed,
                       device.physical().name, limit);
  if (parameters.vulkanPath == VulkanPath::query) return "ray queries are asked for (--vulkan-path)";
  return {};
}

}  // namespace

TracingChoice chooseTracing(const Device& device, const render::MethodInfo& method, const pack::Scene& scene,
                            const render::RenderParameters& parameters) {
  if (parameters.vulkanPath == VulkanPath::query) requireRayQueries(device);
  TracingChoice choice;
  if (!method.isIterative) {
    choice.withoutRecursion = findRecursionProblem(device, parameters);
    if (choice.withoutRecursion.empty() && render::filtersShadows(scene, parameters))
      choice.withoutRecursion = "light passes surfaces on its way to others (filtered-shadows)";
    if (choice.withoutRecursion.empty()) return choice;
  }
  const bool usesQueries = parameters.vulkanPath != VulkanPath::pipeline && device.capabilities().rayQuery;
  choice.tracing = usesQueries ? Tracing::rayQueries : Tracing::hitRecords;
  return choice;
}

std::vector<VulkanPath> availablePaths(const Device& device) {
  if (!device.capabilities().rayQuery) return {VulkanPath::pipeline};
  return {VulkanPath::query, VulkanPath::pipeline};
}

VulkanPath vulkanPath(Tracing tracing) {
  return tracing == Tracing::rayQueries ? VulkanPath::query : VulkanPath::pipeline;
}

}  // namespace malus::vulkan
