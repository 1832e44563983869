// Memory types, heaps and uploads on a simulated discrete GPU.
#include "render/vulkan/memory.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/vulkan/uploads.h"
#include "tests/render/vulkan/vulkan_calls.h"

namespace malus::vulkan {
namespace {

constexpr std::uint64_t kMany = std::uint64_t{1} << 30;

class VulkanMemory : public testing::Test {
 protected:
  VulkanMemory() { test::watchVulkanCalls(0); }
  ~VulkanMemory() override { test::endSimulatedMemory(); }

  static Buffer makeBuffer(const Device& device, VkDeviceSize bytes, MemoryUse use) {
    return {device, "numbers", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, use};
  }
  static std::vector<std::uint32_t> types() {
    std::vector<std::uint32_t> result;
    for (const test::Allocation& a : test::vulkanCalls().allocations) result.push_back(a.type);
    return result;
  }
};

TEST_F(VulkanMemory, EachUseHasItsType) {
  test::simulateMemory({kMany, kMany, kMany});
  const Instance instance(0);
  const Device device(instance, "");
  const Buffer buffers[] = {makeBuffer(device, 64, kDeviceMemory), makeBuffer(device, 64, kUploadMemory),
                            makeBuffer(device, 64, kReadBackMemory), makeBuffer(device, 64, kSharedMemory)};
  EXPECT_EQ(types(), (std::vector<std::uint32_t>{test::kLocal, test::kHost, test::kHostCached, test::kLocalHost}));
}

TEST_F(VulkanMemory, FullOrSmallHeapIsReplaced) {
  test::simulateMemory({1000, kMany, kMany});
  const Instance instance(0);
  const Device device(instance, "");
  // The third would overfill the heap; the fourth is larger than the heap.
  const Buffer buffers[] = {makeBuffer(device, 400, kDeviceMemory), makeBuffer(device, 400, kDeviceMemory),
                            makeBuffer(device, 400, kDeviceMemory), makeBuffer(device, 4000, kDeviceMemory)};
  EXPECT_EQ(types(), (std::vector<std::uint32_t>{test::kLocal, test::kLocal, test::kLocalHost, test::kLocalHost}));
}

TEST_F(VulkanMemory, SharedMemoryNeedNotBeLocal) {
  test::simulateMemory({kMany, kMany, 100});
  const Instance instance(0);
  const Device device(instance, "");
  const Buffer buffer = makeBuffer(device, 400, kSharedMemory);
  EXPECT_EQ(types(), std::vector<std::uint32_t>{test::kHost});
}

TEST_F(VulkanMemory, FullHeapsAreReported) {
  test::simulateMemory({1000, kMany, 500});
  const Instance instance(0);
  const Device device(instance, "");
  const Buffer buffers[] = {makeBuffer(device, 800, kDeviceMemory), makeBuffer(device, 400, kDeviceMemory)};
  try {
    makeBuffer(device, 208, kDeviceMemory);
    FAIL();
  } catch (const Error& error) {
    for (const char* word : {"numbers, 208 bytes", "heap 0", "1000 bytes", "--device", "out of device memory"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " in: " << error.what();
  }
}

TEST_F(VulkanMemory, LargeArraysAreUploadedInParts) {
  const Instance instance(0);
  const Device device(instance, "");
  std::vector<std::uint32_t> values(kUploadBytes / 4 * 2 + 1000);
  std::iota(values.begin(), values.end(), 7u);
  const Buffer buffer = upload(device, "numbers", std::as_bytes(std::span(values)), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  EXPECT_EQ(test::vulkanCalls().largestUpload, kUploadBytes);
  const Buffer copy = makeBuffer(device, values.size() * 4, kReadBackMemory);
  device.submit("copy", [&](VkCommandBuffer commands) {
    const VkBufferCopy all{0, 0, values.size() * 4};
    vkCmdCopyBuffer(commands, buffer.get(), copy.get(), 1, &all);
  });
  std::vector<std::uint32_t> found(values.size());
  copy.read(std::as_writable_bytes(std::span(found)));
  EXPECT_EQ(found, values);
  instance.requireNoMessages();
}

}  // namespace
}  // namespace malus::vulkan
