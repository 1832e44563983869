// Buffers in memory that another VkDevice of the same physical device exported (render/shared_pixels.h), imported by
// VK_KHR_external_memory_fd.
#pragma once

#include <memory>
#include <vector>

#include "render/shared_pixels.h"
#include "render/vulkan/device.h"

namespace malus::vulkan {

// Usage of a buffer in shared memory, on both devices.
inline constexpr VkBufferUsageFlags kSharedUsage =
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
inline constexpr VkExternalMemoryHandleTypeFlagBits kSharedHandle = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;

class SharedTargets {
 public:
  // device: must outlive the targets.
  explicit SharedTargets(const Device& device) : device_(device) {}

  // Imports the memory, unless it is imported already. Returns false if it is memory of another device, or if the
  // device does not import memory. Memory that its owner has released is released here too.
  bool accept(const std::shared_ptr<const render::SharedPixels>& pixels);
  // The buffer in accepted memory.
  VkBuffer buffer(const render::SharedPixels& pixels) const;
  // Releases all memory.
  void release() { targets_.clear(); }

  // Records a copy into the buffer and hands the written part to the other device (a release to
  // VK_QUEUE_FAMILY_EXTERNAL, which the other device must acquire). The source must be visible to transfers.
  void recordCopy(VkCommandBuffer commands, VkBuffer from, const render::SharedPixels& to, VkDeviceSize offset,
                  VkDeviceSize bytes) const;

 private:
  struct Target {
    std::weak_ptr<const render::SharedPixels> pixels;
    Owned<VkDeviceMemory> memory;
    Owned<VkBuffer> buffer;  // destroyed before its memory
  };
  bool isOfDevice(const render::SharedPixels& pixels) const;
  bool import(const std::shared_ptr<const render::SharedPixels>& pixels);

  const Device& device_;
  std::vector<Target> targets_;
};

}  // namespace malus::vulkan
