#include "render/vulkan/buffer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "render/vulkan/check.h"

namespace malus::vulkan {

Buffer::Buffer(const Device& device, VkDeviceSize sizeBytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags memory)
    : device_(&device), sizeBytes_(std::max<VkDeviceSize>(sizeBytes, 16)) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = sizeBytes_;
  info.usage = usage;
  check(vkCreateBuffer(device.get(), &info, nullptr, &buffer_), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.get(), buffer_, &needs);
  VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  if ((usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0) allocate.pNext = &flags;
  allocate.allocationSize = needs.size;
  try {
    allocate.memoryTypeIndex = device.memoryType(needs.memoryTypeBits, memory);
    check(vkAllocateMemory(device.get(), &allocate, nullptr, &memory_), "vkAllocateMemory");
    check(vkBindBufferMemory(device.get(), buffer_, memory_, 0), "vkBindBufferMemory");
  } catch (...) {
    if (memory_) vkFreeMemory(device.get(), memory_, nullptr);
    vkDestroyBuffer(device.get(), buffer_, nullptr);
    throw;
  }
}

Buffer::~Buffer() {
  if (buffer_) vkDestroyBuffer(device_->get(), buffer_, nullptr);
  if (memory_) vkFreeMemory(device_->get(), memory_, nullptr);
}

Buffer::Buffer(Buffer&& other) noexcept { *this = std::move(other); }

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(sizeBytes_, other.sizeBytes_);
  return *this;
}

VkDeviceAddress Buffer::address() const {
  VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  info.buffer = buffer_;
  return device_->getBufferDeviceAddress(device_->get(), &info);
}

void Buffer::write(std::span<const std::byte> bytes) {
  void* to = nullptr;
  check(vkMapMemory(device_->get(), memory_, 0, VK_WHOLE_SIZE, 0, &to), "vkMapMemory");
  std::memcpy(to, bytes.data(), bytes.size());
  vkUnmapMemory(device_->get(), memory_);
}

void Buffer::read(std::span<std::byte> bytes) const {
  void* from = nullptr;
  check(vkMapMemory(device_->get(), memory_, 0, VK_WHOLE_SIZE, 0, &from), "vkMapMemory");
  std::memcpy(bytes.data(), from, bytes.size());
  vkUnmapMemory(device_->get(), memory_);
}

Buffer uploaded(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage) {
  Buffer result(device, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  if (bytes.empty()) return result;
  Buffer staging(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                 VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  staging.write(bytes);
  device.submit([&](VkCommandBuffer commands) {
    const VkBufferCopy copy{0, 0, bytes.size()};
    vkCmdCopyBuffer(commands, staging.get(), result.get(), 1, &copy);
  });
  return result;
}

}  // namespace malus::vulkan
