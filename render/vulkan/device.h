// A ray-tracing device: choosing one, its queue, and the extension functions that the loader does not export.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "render/vulkan/instance.h"

namespace malus::vulkan {

struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  std::string name;
  std::string driver;   // "llvmpipe Mesa 25.0.7"
  std::string problem;  // why it cannot be used; empty: it can
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
};

std::vector<PhysicalDevice> describeDevices(const Instance& instance);

class Device {
 public:
  // wanted: number or part of a name, "" for MALUS_DEVICE or else the best (a discrete GPU before an
  // integrated one before a CPU). statistics: also what its compiler tells about pipelines, where it does.
  // Throws Error: none, an unknown one, one without ray tracing.
  Device(const Instance& instance, const std::string& wanted, bool statistics = false);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkDevice get() const { return device_; }
  const PhysicalDevice& physical() const { return physical_; }
  const VkPhysicalDeviceRayTracingPipelinePropertiesKHR& rayTracing() const { return rayTracing_; }
  VkDeviceSize maxStorageBufferBytes() const { return maxStorageBufferBytes_; }
  std::uint32_t scratchAlignment() const { return scratchAlignment_; }
  double timestampPeriodNs() const { return timestampPeriodNs_; }  // 0: the queue has no timestamps
  bool hasRayQueries() const { return rayQueries_; }
  bool hasStatistics() const { return getPipelineExecutableStatistics != nullptr; }
  std::uint32_t memoryType(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const;

  // Records commands, runs them and waits.
  void submit(const std::function<void(VkCommandBuffer)>& record) const;

  PFN_vkGetBufferDeviceAddress getBufferDeviceAddress = nullptr;
  PFN_vkCreateAccelerationStructureKHR createAccelerationStructure = nullptr;
  PFN_vkDestroyAccelerationStructureKHR destroyAccelerationStructure = nullptr;
  PFN_vkGetAccelerationStructureBuildSizesKHR getAccelerationStructureBuildSizes = nullptr;
  PFN_vkGetAccelerationStructureDeviceAddressKHR getAccelerationStructureDeviceAddress = nullptr;
  PFN_vkCmdBuildAccelerationStructuresKHR cmdBuildAccelerationStructures = nullptr;
  PFN_vkCreateRayTracingPipelinesKHR createRayTracingPipelines = nullptr;
  PFN_vkGetRayTracingShaderGroupHandlesKHR getRayTracingShaderGroupHandles = nullptr;
  PFN_vkCmdTraceRaysKHR cmdTraceRays = nullptr;
  PFN_vkGetRayTracingShaderGroupStackSizeKHR getRayTracingShaderGroupStackSize = nullptr;
  PFN_vkGetPipelineExecutablePropertiesKHR getPipelineExecutableProperties = nullptr;  // null without statistics
  PFN_vkGetPipelineExecutableStatisticsKHR getPipelineExecutableStatistics = nullptr;

 private:
  PhysicalDevice physical_;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkPhysicalDeviceRayTracingPipelinePropertiesKHR rayTracing_{};
  VkDeviceSize maxStorageBufferBytes_ = 0;
  std::uint32_t scratchAlignment_ = 1;
  double timestampPeriodNs_ = 0;
  bool rayQueries_ = false;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
};

}  // namespace malus::vulkan
