// Device memory for buffers, within the limits and heaps of the device.
#pragma once

#include <string_view>

#include "render/vulkan/device.h"

namespace malus::vulkan {

// Properties of a memory type: all of `required`, and of `preferred` if a type has them.
struct MemoryUse {
  VkMemoryPropertyFlags required;
  VkMemoryPropertyFlags preferred = 0;
};
inline constexpr VkMemoryPropertyFlags kHostMemory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
// Read and written by shaders only.
inline constexpr MemoryUse kDeviceMemory{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
// Written by the host, copied from once.
inline constexpr MemoryUse kUploadMemory{kHostMemory};
// Read by the host: reads of uncached memory are slow.
inline constexpr MemoryUse kReadBackMemory{kHostMemory, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
// Small structs that the host writes and every shader invocation reads.
inline constexpr MemoryUse kSharedMemory{kHostMemory, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};

// Allocates memory for a buffer. Tries every suitable memory type whose heap is large enough. purpose: of the buffer,
// for messages. addressable: the buffer has VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT. Throws Error: no suitable type,
// more bytes than maxMemoryAllocationSize or the heap, out of memory; with the need and the limit.
Owned<VkDeviceMemory> allocateMemory(const Device& device, std::string_view purpose,
                                     const VkMemoryRequirements& requirements, MemoryUse use, bool addressable);

}  // namespace malus::vulkan
