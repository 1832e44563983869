// The description of a device, and MALUS_VULKAN_LIMITS, which lowers it for other tests.
#include "render/vulkan/capabilities.h"

#include <string>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/vulkan/device.h"
#include "tests/render/vulkan/limits.h"

namespace malus::vulkan {
namespace {

Capabilities lowered(const char* limits) {
  const test::Limits scope(limits);
  const Instance instance(0);
  return Device(instance, "").capabilities();
}

// The message of the Error of a list; empty: no error.
std::string rejection(const char* limits) {
  try {
    lowered(limits);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(VulkanCapabilities, DescribeTheDevice) {
  const Capabilities device = lowered("");
  EXPECT_GE(device.apiVersion, VK_API_VERSION_1_2);
  EXPECT_TRUE(device.has(VK_KHR_RAY_QUERY_EXTENSION_NAME));
  EXPECT_TRUE(device.rayQuery);
  EXPECT_TRUE(device.rayTracingPipeline);
  // Lower bounds of the specification, "Limit Requirements".
  EXPECT_GE(device.maxStorageBufferRange, std::uint64_t{1} << 27);
  EXPECT_GE(device.maxMemoryAllocationSize, std::uint64_t{1} << 30);
  EXPECT_GE(device.maxRayRecursionDepth, 1u);
  EXPECT_GE(device.maxRayDispatchInvocationCount, std::uint64_t{1} << 20);  // lavapipe has less than required
  EXPECT_EQ(device.shaderGroupHandleSize, 32u);
  EXPECT_GE(device.memory.memoryHeapCount, 1u);
  EXPECT_GT(device.memory.memoryHeaps[0].size, 0u);
}

TEST(VulkanCapabilities, LimitsOnlyBecomeStricter) {
  const Capabilities device = lowered("");
  const Capabilities found = lowered(
      "rayQuery=0,maxRayRecursionDepth=1,maxStorageBufferRange=1048576,memoryHeapSize=4096,shaderGroupBaseAlignment="
      "256,"
      "timestampValidBits=0,maxMemoryAllocationSize=18446744073709551615");
  EXPECT_FALSE(found.rayQuery);
  EXPECT_TRUE(found.has(VK_KHR_RAY_QUERY_EXTENSION_NAME));
  EXPECT_EQ(found.maxRayRecursionDepth, 1u);
  EXPECT_EQ(found.maxStorageBufferRange, 1048576u);
  EXPECT_EQ(found.shaderGroupBaseAlignment, 256u);
  EXPECT_EQ(found.timestampValidBits, 0u);
  EXPECT_EQ(found.maxMemoryAllocationSize, device.maxMemoryAllocationSize);
  for (std::uint32_t i = 0; i < found.memory.memoryHeapCount; ++i) EXPECT_EQ(found.memory.memoryHeaps[i].size, 4096u);
}

TEST(VulkanCapabilities, ExtensionHidesItsFeatures) {
  const Capabilities found = lowered("VK_KHR_ray_query=0,VK_KHR_pipeline_executable_properties=0");
  EXPECT_FALSE(found.has(VK_KHR_RAY_QUERY_EXTENSION_NAME));
  EXPECT_FALSE(found.rayQuery);
  EXPECT_FALSE(found.pipelineExecutableInfo);
}

TEST(VulkanCapabilities, DeviceWithoutANeedIsRefused) {
  EXPECT_NE(rejection("VK_KHR_ray_tracing_pipeline=0").find("VK_KHR_ray_tracing_pipeline"), std::string::npos);
  EXPECT_NE(rejection("rayTracingPipeline=0").find("rayTracingPipeline"), std::string::npos);
  EXPECT_NE(rejection("accelerationStructure=0").find("accelerationStructure"), std::string::npos);
}

TEST(VulkanCapabilities, InvalidLimitsAreRejected) {
  for (const char* limits : {"noSuchLimit=1", "VK_KHR_no_such_extension=0", "rayQuery=1", "VK_KHR_ray_query=1",
                             "maxRayRecursionDepth", "maxRayRecursionDepth=", "maxRayRecursionDepth=-1",
                             "maxRayRecursionDepth=1x", "=1", ",", "rayQuery=0,noSuchLimit=1"})
    EXPECT_NE(rejection(limits).find("MALUS_VULKAN_LIMITS"), std::string::npos) << limits;
}

}  // namespace
}  // namespace malus::vulkan
