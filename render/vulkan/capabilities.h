// The only description of a Vulkan device that decisions depend on: its extensions, features, limits and memory. The
// members are named as in the Vulkan specification.
//
// The environment variable MALUS_VULKAN_LIMITS hides extensions and features and lowers limits here, for tests of what
// replaces them: "rayQuery=0,maxRayRecursionDepth=1" (render/README.md lists the names).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vulkan/vulkan.h>

namespace malus::vulkan {

struct Capabilities {
  std::uint32_t apiVersion = 0;
  std::vector<std::string> extensions;

  // Features; false also if their extension is missing.
  bool rayTracingPipeline = false;
  bool accelerationStructure = false;
  bool bufferDeviceAddress = false;
  bool scalarBlockLayout = false;
  bool rayQuery = false;
  bool pipelineExecutableInfo = false;

  // Limits. Sizes and alignments are in bytes.
  std::uint64_t maxStorageBufferRange = 0;
  std::uint64_t maxMemoryAllocationSize = 0;
  std::uint64_t maxRayRecursionDepth = 0;
  std::uint64_t maxRayDispatchInvocationCount = 0;
  std::uint64_t maxGeometryCount = 0;   // geometries of a bottom-level structure
  std::uint64_t maxPrimitiveCount = 0;  // triangles of a bottom-level structure
  std::uint64_t shaderGroupHandleSize = 0;
  std::uint64_t shaderGroupHandleAlignment = 1;
  std::uint64_t shaderGroupBaseAlignment = 1;
  std::uint64_t minAccelerationStructureScratchOffsetAlignment = 1;

  VkPhysicalDeviceMemoryProperties memory{};  // types and heaps
  bool hasComputeQueue = false;
  std::uint32_t queueFamily = 0;         // the first with compute work, which includes ray tracing
  std::uint64_t timestampValidBits = 0;  // of the queue family; 0: it has no timestamps
  double timestampPeriod = 0;            // nanoseconds per tick

  // Identity of the driver's compiled pipelines.
  std::uint32_t vendorID = 0, deviceID = 0, driverVersion = 0;
  std::array<std::uint8_t, VK_UUID_SIZE> pipelineCacheUUID{};
  // Devices with the same two values can share memory.
  std::array<std::uint8_t, VK_UUID_SIZE> deviceUUID{}, driverUUID{};

  bool has(std::string_view extension) const;
};

// Features (0 or 1), limits and, as memoryHeapSize, the size of the largest device-local heap [bytes], by their names.
std::vector<std::pair<std::string, std::uint64_t>> listValues(const Capabilities& capabilities);

// Reads the description of a device and lowers it by MALUS_VULKAN_LIMITS, a list of NAME=VALUE, separated by commas.
// NAME is an extension or a feature, which the value 0 hides; a limit, lowered to the value; an alignment, raised to
// the value; or memoryHeapSize, to which the size of every heap is lowered. A value less strict than the device's
// own changes nothing. Throws Error: an unknown name, an invalid value, a failed call.
Capabilities readCapabilities(VkPhysicalDevice device);

}  // namespace malus::vulkan
