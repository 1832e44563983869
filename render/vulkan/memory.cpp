#include "render/vulkan/memory.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

namespace {

constexpr const char* kReduce =
    "reduce the scene's meshes or textures, use another device (--device), or --backend embree";

// Indices of the suitable memory types: those with the preferred properties first, otherwise in the driver's order.
std::vector<std::uint32_t> suitableTypes(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                         MemoryUse use) {
  std::vector<std::uint32_t> types;
  const auto has = [&](std::uint32_t type, VkMemoryPropertyFlags flags) {
    return (memory.memoryTypes[type].propertyFlags & flags) == flags;
  };
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1) != 0 && has(i, use.required)) types.push_back(i);
  std::stable_partition(types.begin(), types.end(), [&](std::uint32_t i) { return has(i, use.preferred); });
  return types;
}

// The largest of the types' heaps.
std::uint32_t largestHeap(const VkPhysicalDeviceMemoryProperties& memory, const std::vector<std::uint32_t>& types) {
  std::uint32_t largest = memory.memoryTypes[types.front()].heapIndex;
  for (const std::uint32_t type : types)
    if (const std::uint32_t heap = memory.memoryTypes[type].heapIndex;
        memory.memoryHeaps[heap].size > memory.memoryHeaps[largest].size)
      largest = heap;
  return largest;
}

std::string describeHeap(const Device& device, std::uint32_t heap) {
  const Capabilities& capabilities = device.capabilities();
  std::string text = fmt::format("memory heap {} of device '{}' has {} bytes", heap, device.physical().name,
                                 capabilities.memory.memoryHeaps[heap].size);
  if (!capabilities.has(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME)) return text;
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
  VkPhysicalDeviceMemoryProperties2 memory{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2, &budget};
  vkGetPhysicalDeviceMemoryProperties2(device.physical().handle, &memory);
  return text +
         fmt::format(", of which this program may use {} and uses {}", budget.heapBudget[heap], budget.heapUsage[heap]);
}

// Throws Error if no allocation of this size can succeed.
void requireWithinLimits(const Device& device, std::string_view purpose, VkDeviceSize bytes,
                         const std::vector<std::uint32_t>& types) {
  const auto reject = [&](const std::string& limit) {
    throw Error("Vulkan", fmt::format("the buffer '{}' is too large for device '{}'", purpose, device.physical().name),
                fmt::format("at most {}; {}", limit, kReduce), fmt::format("{} bytes", bytes));
  };
  const Capabilities& limits = device.capabilities();
  if (bytes > limits.maxMemoryAllocationSize)
    reject(fmt::format("{} bytes (maxMemoryAllocationSize)", limits.maxMemoryAllocationSize));
  const std::uint32_t heap = largestHeap(limits.memory, types);
  const VkDeviceSize size = limits.memory.memoryHeaps[heap].size;
  if (bytes > size) reject(fmt::format("{} bytes (memory heap {})", size, heap));
}

}  // namespace

Owned<VkDeviceMemory> allocateMemory(const Device& device, std::string_view purpose,
                                     const VkMemoryRequirements& requirements, MemoryUse use, bool addressable) {
  const VkPhysicalDeviceMemoryProperties& memory = device.capabilities().memory;
  const std::vector<std::uint32_t> types = suitableTypes(memory, requirements.memoryTypeBits, use);
  if (types.empty())
    throw Error("Vulkan",
                fmt::format("device '{}' has no memory type with property flags {:#x} for the buffer '{}'",
                            device.physical().name, use.required, purpose),
                "another device from 'malus --list-devices' (--device) or --backend embree");
  requireWithinLimits(device, purpose, requirements.size, types);

  VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  if (addressable) info.pNext = &flags;
  info.allocationSize = requirements.size;
  VkResult result = VK_SUCCESS;
  for (const std::uint32_t type : types) {
    info.memoryTypeIndex = type;
    if (memory.memoryHeaps[memory.memoryTypes[type].heapIndex].size < requirements.size) continue;
    VkDeviceMemory handle = VK_NULL_HANDLE;
    result = vkAllocateMemory(device.get(), &info, nullptr, &handle);
    if (result == VK_SUCCESS) return {device.get(), handle, vkFreeMemory};
  }
  throw Error("Vulkan", fmt::format("vkAllocateMemory ({}, {} bytes) failed", purpose, requirements.size),
              fmt::format("enough memory: {}; end other programs, {}", describeHeap(device, largestHeap(memory, types)),
                          kReduce),
              resultName(result));
}

}  // namespace malus::vulkan
