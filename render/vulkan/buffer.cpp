#include "render/vulkan/buffer.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include <fmt/format.h>

namespace malus::vulkan {

Buffer::Buffer(const Device& device, std::string_view purpose, VkDeviceSize sizeBytes, VkBufferUsageFlags usage,
               MemoryUse memory)
    : device_(&device), sizeBytes_(std::max<VkDeviceSize>(sizeBytes, 16)) {
  const auto step = [&](const char* function) {
    return fmt::format("{} ({}, {} bytes)", function, purpose, sizeBytes_);
  };
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = sizeBytes_;
  info.usage = usage;
  buffer_ = create(device.get(), vkCreateBuffer, info, vkDestroyBuffer, step("vkCreateBuffer"));

  VkMemoryRequirements requirements;
  vkGetBufferMemoryRequirements(device.get(), get(), &requirements);
  memory_ =
      allocateMemory(device, purpose, requirements, memory, (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0);
  check(vkBindBufferMemory(device.get(), get(), memory_.get(), 0), step("vkBindBufferMemory"));
  if ((memory.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) return;
  void* mapped = nullptr;
  check(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), step("vkMapMemory"));
  mapped_ = static_cast<std::byte*>(mapped);
}

VkDeviceAddress Buffer::address() const {
  VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  info.buffer = get();
  return device_->functions().getBufferDeviceAddress(device_->get(), &info);
}

void Buffer::write(std::span<const std::byte> bytes, VkDeviceSize offset) {
  assert(mapped_ && offset + bytes.size() <= sizeBytes_);
  std::memcpy(mapped_ + offset, bytes.data(), bytes.size());
}

void Buffer::read(std::span<std::byte> bytes) const {
  assert(mapped_ && bytes.size() <= sizeBytes_);
  std::memcpy(bytes.data(), mapped_, bytes.size());
}

}  // namespace malus::vulkan
