// The description of devices for users.
#include "render/vulkan/device_description.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "render/vulkan/ray_tracing_cores.h"
#include "tests/render/vulkan/limits.h"

namespace malus::vulkan {
namespace {

std::uint64_t value(const DeviceDescription& device, std::string_view name) {
  const auto found =
      std::find_if(device.values.begin(), device.values.end(), [&](const auto& v) { return v.first == name; });
  return found == device.values.end() ? ~std::uint64_t{0} : found->second;
}

TEST(DeviceDescription, HasFeaturesAndLimits) {
  const DeviceDescription device = chosenDevice("");
  EXPECT_EQ(device.type, "CPU");
  EXPECT_EQ(device.rayTracingCores, "no");
  EXPECT_EQ(value(device, "rayQuery"), 1u);
  EXPECT_GE(value(device, "maxRayRecursionDepth"), 1u);
  EXPECT_GT(value(device, "memoryHeapSize"), std::uint64_t{1} << 28);
  const nlohmann::json document = toJson(device);
  EXPECT_TRUE(document.at("problem").is_null());
  EXPECT_EQ(document.at("values").at("rayQuery"), 1);
}

TEST(DeviceDescription, FollowsTheLoweredLimits) {
  const test::Limits scope("rayQuery=0,maxRayRecursionDepth=3,memoryHeapSize=1000000");
  const DeviceDescription device = chosenDevice("");
  EXPECT_EQ(value(device, "rayQuery"), 0u);
  EXPECT_EQ(value(device, "maxRayRecursionDepth"), 3u);
  EXPECT_EQ(value(device, "memoryHeapSize"), 1000000u);
}

TEST(DeviceDescription, NamesRayTracingCores) {
  constexpr std::uint32_t kNvidia = 0x10DE, kAmd = 0x1002;
  constexpr VkPhysicalDeviceType kGpu = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
  EXPECT_EQ(rayTracingCores(kGpu, kNvidia, "NVIDIA H200"), "no");
  EXPECT_EQ(rayTracingCores(kGpu, kNvidia, "NVIDIA A100-SXM4-80GB"), "no");
  EXPECT_EQ(rayTracingCores(kGpu, kNvidia, "NVIDIA GeForce RTX 4090"), "yes");
  EXPECT_EQ(rayTracingCores(kGpu, kNvidia, "NVIDIA L4"), "yes");
  EXPECT_EQ(rayTracingCores(kGpu, kNvidia, "NVIDIA GeForce GTX 1080"), "unknown");
  EXPECT_EQ(rayTracingCores(kGpu, kAmd, "AMD Radeon RX 7900 XTX"), "unknown");
  EXPECT_EQ(rayTracingCores(VK_PHYSICAL_DEVICE_TYPE_CPU, kNvidia, "RTX"), "no");
}

}  // namespace
}  // namespace malus::vulkan
