// The image that the shaders write (MALUS_PIXEL_BUFFER of shaders/gpu/bindings.def), and its copy for the host.
#pragma once

#include <span>

#include "render/vulkan/bindings.h"

namespace malus::vulkan {

class PixelBuffer {
 public:
  // device: must outlive the buffer.
  explicit PixelBuffer(const Device& device) : device_(device) {}

  // Provides room for `floats` values and binds it. Keeps larger buffers of earlier images. After an Error the buffer
  // is as before.
  void reserve(std::size_t floats, Bindings& bindings);

  VkBuffer get() const { return pixels_.get(); }
  // Records that transfers wait for the shaders' values.
  void recordBarrier(VkCommandBuffer commands) const;
  // Provides room for a copy of the reserved values on the host. Throws Error.
  void reserveCopy();
  // Records the copy of the first `floats` values to the host, after recordBarrier().
  void recordCopy(VkCommandBuffer commands, std::size_t floats) const;
  // Reads values.size() values that have been copied. Throws Error.
  void read(std::span<float> values) const;

 private:
  const Device& device_;
  Buffer pixels_, copy_;
};

}  // namespace malus::vulkan
