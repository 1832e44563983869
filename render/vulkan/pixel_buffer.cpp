#include "render/vulkan/pixel_buffer.h"

#include <utility>

namespace malus::vulkan {

void PixelBuffer::reserve(std::size_t floats, Bindings& bindings) {
  const VkDeviceSize bytes = floats * sizeof(float);
  if (pixels_.sizeBytes() >= bytes) return;
  Buffer pixels(device_, "pixels", bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                kDeviceMemory);
  bindings.bind(Binding::pixels, pixels);
  pixels_ = std::move(pixels);
}

void PixelBuffer::reserveCopy() {
  if (copy_.sizeBytes() < pixels_.sizeBytes())
    copy_ =
        Buffer(device_, "copy of the pixels", pixels_.sizeBytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, kReadBackMemory);
}

void PixelBuffer::recordBarrier(VkCommandBuffer commands) const {
  const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_SHADER_WRITE_BIT,
                                VK_ACCESS_TRANSFER_READ_BIT};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_RAY_TRACING_SHADER_BIT_KHR, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1,
                       &barrier, 0, nullptr, 0, nullptr);
}

void PixelBuffer::recordCopy(VkCommandBuffer commands, std::size_t floats) const {
  const VkBufferCopy copy{0, 0, floats * sizeof(float)};
  vkCmdCopyBuffer(commands, pixels_.get(), copy_.get(), 1, &copy);
}

void PixelBuffer::read(std::span<float> values) const { copy_.read(std::as_writable_bytes(values)); }

}  // namespace malus::vulkan
