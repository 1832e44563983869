// Buffers that the host writes or reads at each render, one for each MALUS_HOST_BUFFER of shaders/gpu/bindings.def.
#pragma once

#include <span>

#include "render/vulkan/bindings.h"
#include "shaders/gpu/fault.h"
#include "shaders/gpu/scene.h"

namespace malus::vulkan {

// A host-visible buffer with one value.
template <typename T>
class HostBuffer {
 public:
  HostBuffer() = default;
  HostBuffer(const Device& device, std::string_view purpose)
      : buffer_(device, purpose, sizeof(T), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kSharedMemory) {}
  void write(const T& value) { buffer_.write(std::as_bytes(std::span(&value, 1))); }
  T read() const {
    T value{};
    buffer_.read(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
  const Buffer& buffer() const { return buffer_; }

 private:
  Buffer buffer_;
};

struct HostBuffers {
  // device: must outlive the buffers. Throws Error.
  HostBuffers(const Device& device, Bindings& bindings);

#define MALUS_ACCELERATION_STRUCTURE(number, name)
#define MALUS_PIXEL_BUFFER(number, name, element)
#define MALUS_SCENE_BUFFER(number, name, element, usage)
#define MALUS_HOST_BUFFER(number, name, type, access) HostBuffer<gpu::type> name;
#include "shaders/gpu/bindings.def"
};

}  // namespace malus::vulkan
