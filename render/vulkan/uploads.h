// Contents of device-local buffers, copied together.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/vulkan/buffer.h"

namespace malus::vulkan {

// Most bytes of the host-visible memory of an upload. More are copied in several submissions.
inline constexpr VkDeviceSize kUploadBytes = VkDeviceSize{1} << 24;

class Uploads {
 public:
  // device: must outlive the uploads. purpose: for messages. totalBytes: of all contents; host-visible memory for
  // them, at most kUploadBytes, is allocated. Throws Error.
  Uploads(const Device& device, std::string_view purpose, VkDeviceSize totalBytes);

  // Copies bytes to the start of a buffer with VK_BUFFER_USAGE_TRANSFER_DST_BIT, by the next submission at the latest
  // in finish(). The VkBuffer must live until then. Throws Error.
  void add(std::span<const std::byte> bytes, const Buffer& destination);
  // Makes a device-local buffer with these contents after finish(). Throws Error.
  Buffer add(std::string_view purpose, std::span<const std::byte> bytes, VkBufferUsageFlags usage);

  // Submits what is left and waits. Throws Error.
  void finish();

 private:
  struct Copy {
    VkBuffer destination;
    VkBufferCopy region;
  };

  const Device& device_;
  std::string step_;
  Buffer staging_;
  VkDeviceSize used_ = 0;  // of staging_
  std::vector<Copy> copies_;
};

// Copies bytes into a buffer with VK_BUFFER_USAGE_TRANSFER_DST_BIT and waits. Throws Error.
void copyToBuffer(const Device& device, std::string_view purpose, std::span<const std::byte> bytes,
                  const Buffer& destination);

// Makes a device-local buffer with these contents. Throws Error.
Buffer upload(const Device& device, std::string_view purpose, std::span<const std::byte> bytes,
              VkBufferUsageFlags usage);

}  // namespace malus::vulkan
