// Buffers with their memory.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "render/vulkan/memory.h"

namespace malus::vulkan {

class Buffer {
 public:
  Buffer() = default;
  // device: must outlive the buffer. purpose: for messages, such as "normals". A size of 0 bytes is raised to 16, so
  // that the buffer can be bound. Throws Error: as allocateMemory().
  Buffer(const Device& device, std::string_view purpose, VkDeviceSize sizeBytes, VkBufferUsageFlags usage,
         MemoryUse memory);

  VkBuffer get() const { return buffer_.get(); }
  VkDeviceSize sizeBytes() const { return sizeBytes_; }
  // Needs VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT.
  VkDeviceAddress address() const;
  // Both need host-visible memory and access at most sizeBytes() bytes. offset: where the bytes begin.
  void write(std::span<const std::byte> bytes, VkDeviceSize offset = 0);
  void read(std::span<std::byte> bytes) const;

 private:
  const Device* device_ = nullptr;
  Owned<VkDeviceMemory> memory_;
  Owned<VkBuffer> buffer_;  // destroyed before its memory
  VkDeviceSize sizeBytes_ = 0;
  std::byte* mapped_ = nullptr;  // host-visible memory, until it is freed
};

}  // namespace malus::vulkan
