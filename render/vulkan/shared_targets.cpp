#include "render/vulkan/shared_targets.h"

#include <unistd.h>

#include <algorithm>

#include "meshprep/base/error.h"

namespace malus::vulkan {

bool SharedTargets::isOfDevice(const render::SharedPixels& pixels) const {
  const Capabilities& device = device_.capabilities();
  return device_.importsMemory() && pixels.deviceUUID == device.deviceUUID && pixels.driverUUID == device.driverUUID;
}

bool SharedTargets::accept(const std::shared_ptr<const render::SharedPixels>& pixels) {
  if (!pixels || !isOfDevice(*pixels)) return false;
  std::erase_if(targets_, [](const Target& target) { return target.pixels.expired(); });
  return std::ranges::any_of(targets_, [&](const Target& target) { return target.pixels.lock() == pixels; }) ||
         import(pixels);
}

// Returns false if the driver refuses.
bool SharedTargets::import(const std::shared_ptr<const render::SharedPixels>& pixels) {
  VkDevice device = device_.get();
  VkExternalMemoryBufferCreateInfo external{VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO};
  external.handleTypes = kSharedHandle;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, &external};
  info.size = pixels->bufferBytes;
  info.usage = kSharedUsage;
  auto buffer = create(device, vkCreateBuffer, info, vkDestroyBuffer, "vkCreateBuffer (shared pixels)");

  VkMemoryDedicatedAllocateInfo dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
  dedicated.buffer = buffer.get();
  VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                  pixels->isDedicated ? &dedicated : nullptr};
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkImportMemoryFdInfoKHR imported{VK_STRUCTURE_TYPE_IMPORT_MEMORY_FD_INFO_KHR, &flags};
  imported.handleType = kSharedHandle;
  imported.fd = pixels->exportMemory();
  VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &imported};
  allocation.allocationSize = pixels->allocationBytes;
  allocation.memoryTypeIndex = pixels->memoryType;
  VkDeviceMemory handle = VK_NULL_HANDLE;
  if (vkAllocateMemory(device, &allocation, nullptr, &handle) != VK_SUCCESS) {
    ::close(imported.fd);  // a successful import owns it
    return false;
  }
  Owned<VkDeviceMemory> memory(device, handle, vkFreeMemory);
  check(vkBindBufferMemory(device, buffer.get(), memory.get(), 0), "vkBindBufferMemory (shared pixels)");
  targets_.push_back({pixels, std::move(memory), std::move(buffer)});
  return true;
}

VkBuffer SharedTargets::buffer(const render::SharedPixels& pixels) const {
  for (const Target& target : targets_)
    if (target.pixels.lock().get() == &pixels) return target.buffer.get();
  throw Error("Vulkan", "the shared pixels were not accepted");
}

void SharedTargets::recordCopy(VkCommandBuffer commands, VkBuffer from, const render::SharedPixels& to,
                               VkDeviceSize offset, VkDeviceSize bytes) const {
  VkBufferMemoryBarrier barrier{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER};
  barrier.buffer = buffer(to);
  barrier.offset = offset;
  barrier.size = bytes;
  const VkBufferCopy copy{0, offset, bytes};
  vkCmdCopyBuffer(commands, from, barrier.buffer, 1, &copy);
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.srcQueueFamilyIndex = device_.capabilities().queueFamily;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_EXTERNAL;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 1,
                       &barrier, 0, nullptr);
}

}  // namespace malus::vulkan
