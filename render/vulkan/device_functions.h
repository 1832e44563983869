// Functions that the loader does not export, taken from the device.
#pragma once

#include <vulkan/vulkan.h>

// X(member, function)
#define MALUS_DEVICE_FUNCTIONS(X)                                                            \
  X(getBufferDeviceAddress, vkGetBufferDeviceAddress)                                        \
  X(createAccelerationStructure, vkCreateAccelerationStructureKHR)                           \
  X(destroyAccelerationStructure, vkDestroyAccelerationStructureKHR)                         \
  X(getAccelerationStructureBuildSizes, vkGetAccelerationStructureBuildSizesKHR)             \
  X(getAccelerationStructureDeviceAddress, vkGetAccelerationStructureDeviceAddressKHR)       \
  X(cmdBuildAccelerationStructures, vkCmdBuildAccelerationStructuresKHR)                     \
  X(cmdCopyAccelerationStructure, vkCmdCopyAccelerationStructureKHR)                         \
  X(cmdWriteAccelerationStructuresProperties, vkCmdWriteAccelerationStructuresPropertiesKHR) \
  X(createRayTracingPipelines, vkCreateRayTracingPipelinesKHR)                               \
  X(getRayTracingShaderGroupHandles, vkGetRayTracingShaderGroupHandlesKHR)                   \
  X(getRayTracingShaderGroupStackSize, vkGetRayTracingShaderGroupStackSizeKHR)               \
  X(cmdTraceRays, vkCmdTraceRaysKHR)

// Those of a device that reports statistics of pipelines.
#define MALUS_STATISTICS_FUNCTIONS(X)                                      \
  X(getPipelineExecutableProperties, vkGetPipelineExecutablePropertiesKHR) \
  X(getPipelineExecutableStatistics, vkGetPipelineExecutableStatisticsKHR)

namespace malus::vulkan {

struct DeviceFunctions {
#define MALUS_DECLARE(member, function) PFN_##function member = nullptr;
  MALUS_DEVICE_FUNCTIONS(MALUS_DECLARE)
  MALUS_STATISTICS_FUNCTIONS(MALUS_DECLARE)  // null without statistics
#undef MALUS_DECLARE
};

// Throws Error where the driver lacks a function.
DeviceFunctions loadDeviceFunctions(VkDevice device, bool statistics);

}  // namespace malus::vulkan
