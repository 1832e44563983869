// The descriptor set that every stage of a pipeline sees: one descriptor for each row of shaders/gpu/bindings.def.
#pragma once

#include <cstdint>
#include <string_view>

#include "render/vulkan/buffer.h"

namespace malus::vulkan {

// Binding numbers, by the names of the rows.
enum class Binding : std::uint32_t {
#define MALUS_ACCELERATION_STRUCTURE(number, name) name = number,
#define MALUS_PIXEL_BUFFER(number, name, element) name = number,
#define MALUS_SCENE_BUFFER(number, name, element, usage) name = number,
#define MALUS_HOST_BUFFER(number, name, type, access) name = number,
#include "shaders/gpu/bindings.def"
};

// device: must outlive the layout. Throws Error.
Owned<VkDescriptorSetLayout> createBindingsLayout(const Device& device);

// Throws Error if a buffer of this size cannot be bound (maxStorageBufferRange).
void requireBindable(const Device& device, std::string_view name, VkDeviceSize bytes);

class Bindings {
 public:
  // device: must outlive the set. Throws Error.
  explicit Bindings(const Device& device);

  VkDescriptorSetLayout layout() const { return layout_.get(); }
  const VkDescriptorSet& set() const { return set_; }

  // The buffer and the structure must outlive their use by commands. Throws Error if the buffer is larger than the
  // device can bind.
  void bind(Binding binding, const Buffer& buffer);
  void bind(Binding binding, VkAccelerationStructureKHR structure);

 private:
  const Device& device_;
  Owned<VkDescriptorSetLayout> layout_;
  Owned<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;  // freed with its pool
};

}  // namespace malus::vulkan
