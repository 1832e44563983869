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
}

VkDeviceAddress Buffer::address() const {
  VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  info.buffer = get();
  return device_->functions().getBufferDeviceAddress(device_->get(), &info);
}

void Buffer::write(std::span<const std::byte> bytes, VkDeviceSize offset) {
  assert(offset + bytes.size() <= sizeBytes_);
  void* to = nullptr;
  check(vkMapMemory(device_->get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &to), "vkMapMemory");
  std::memcpy(static_cast<std::byte*>(to) + offset, bytes.data(), bytes.size());
  vkUnmapMemory(device_->get(), memory_.get());
}

void Buffer::read(std::span<std::byte> bytes) const {
  assert(bytes.size() <= sizeBytes_);
  void* from = nullptr;
  check(vkMapMemory(device_->get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &from), "vkMapMemory");
  std::memcpy(bytes.data(), from, bytes.size());
  vkUnmapMemory(device_->get(), memory_.get());
}

}  // namespace malus::vulkan
