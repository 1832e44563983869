// A buffer with its memory.
#pragma once

#include <span>

#include "render/vulkan/device.h"

namespace malus::vulkan {

class Buffer {
 public:
  Buffer() = default;
  // sizeBytes of 0 makes a small buffer, so that every binding has one. Throws Error: out of memory.
  Buffer(const Device& device, VkDeviceSize sizeBytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags memory);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  VkBuffer get() const { return buffer_; }
  VkDeviceSize sizeBytes() const { return sizeBytes_; }
  VkDeviceAddress address() const;               // needs VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT
  void write(std::span<const std::byte> bytes);  // host-visible buffers
  void read(std::span<std::byte> bytes) const;   // host-visible buffers

 private:
  const Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkDeviceSize sizeBytes_ = 0;
};

// Device-local buffer with these contents, by way of a host-visible one.
Buffer uploaded(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage);

}  // namespace malus::vulkan
