#include "render/vulkan/uploads.h"

#include <algorithm>

#include <fmt/format.h>

namespace malus::vulkan {

Uploads::Uploads(const Device& device, std::string_view purpose, VkDeviceSize totalBytes)
    : device_(device),
      step_(fmt::format("upload of {}", purpose)),
      staging_(device, step_, std::min(totalBytes, kUploadBytes), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, kUploadMemory) {}

void Uploads::add(std::span<const std::byte> bytes, const Buffer& destination) {
  for (std::size_t at = 0; at < bytes.size();) {
    if (used_ == staging_.sizeBytes()) finish();
    const std::size_t count = std::min<std::size_t>(bytes.size() - at, staging_.sizeBytes() - used_);
    staging_.write(bytes.subspan(at, count), used_);
    copies_.push_back({destination.get(), {used_, at, count}});
    used_ += count;
    at += count;
  }
}

Buffer Uploads::add(std::string_view purpose, std::span<const std::byte> bytes, VkBufferUsageFlags usage) {
  Buffer result(device_, purpose, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kDeviceMemory);
  add(bytes, result);
  return result;
}

void Uploads::finish() {
  if (copies_.empty()) return;
  device_.submit(step_, [&](VkCommandBuffer commands) {
    for (const Copy& copy : copies_) vkCmdCopyBuffer(commands, staging_.get(), copy.destination, 1, &copy.region);
  });
  copies_.clear();
  used_ = 0;
}

void copyToBuffer(const Device& device, std::string_view purpose, std::span<const std::byte> bytes,
                  const Buffer& destination) {
  if (bytes.empty()) return;
  Uploads uploads(device, purpose, bytes.size());
  uploads.add(bytes, destination);
  uploads.finish();
}

Buffer upload(const Device& device, std::string_view purpose, std::span<const std::byte> bytes,
              VkBufferUsageFlags usage) {
  Buffer result(device, purpose, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kDeviceMemory);
  copyToBuffer(device, purpose, bytes, result);
  return result;
}

}  // namespace malus::vulkan
