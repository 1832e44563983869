// Preloaded in front of the Vulkan loader: counts the bytes that commands copy to memory that is or was mapped, and the
// calls of vkMapMemory. At exit it writes "BYTES MAPPINGS" into the file MALUS_HOST_COPIES.
#include <dlfcn.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <set>

#include <vulkan/vulkan.h>

namespace {

struct Counter {
  std::mutex mutex;
  std::uint64_t bytes = 0, mappings = 0;
  std::set<VkDeviceMemory> mapped;
  std::map<VkBuffer, VkDeviceMemory> memory;

  ~Counter() {
    if (const char* const file = std::getenv("MALUS_HOST_COPIES")) std::ofstream(file) << bytes << ' ' << mappings;
  }
  bool isMapped(VkBuffer buffer) const {
    const auto found = memory.find(buffer);
    return found != memory.end() && mapped.contains(found->second);
  }
};
Counter counter;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

#define EXPORT extern "C" [[gnu::visibility("default")]]

EXPORT VkResult vkMapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                            VkMemoryMapFlags flags, void** data) {
  static const auto kNext = next<PFN_vkMapMemory>("vkMapMemory");
  {
    const std::scoped_lock lock(counter.mutex);
    ++counter.mappings;
    counter.mapped.insert(memory);
  }
  return kNext(device, memory, offset, size, flags, data);
}

EXPORT void vkFreeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* allocator) {
  static const auto kNext = next<PFN_vkFreeMemory>("vkFreeMemory");
  {
    const std::scoped_lock lock(counter.mutex);
    counter.mapped.erase(memory);
  }
  kNext(device, memory, allocator);
}

EXPORT VkResult vkBindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset) {
  static const auto kNext = next<PFN_vkBindBufferMemory>("vkBindBufferMemory");
  {
    const std::scoped_lock lock(counter.mutex);
    counter.memory[buffer] = memory;
  }
  return kNext(device, buffer, memory, offset);
}

EXPORT void vkCmdCopyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                            const VkBufferCopy* regions) {
  static const auto kNext = next<PFN_vkCmdCopyBuffer>("vkCmdCopyBuffer");
  {
    const std::scoped_lock lock(counter.mutex);
    for (std::uint32_t i = 0; counter.isMapped(to) && i < count; ++i) counter.bytes += regions[i].size;
  }
  kNext(commands, from, to, count, regions);
}

EXPORT void vkCmdCopyImageToBuffer(VkCommandBuffer commands, VkImage image, VkImageLayout layout, VkBuffer to,
                                   std::uint32_t count, const VkBufferImageCopy* regions) {
  static const auto kNext = next<PFN_vkCmdCopyImageToBuffer>("vkCmdCopyImageToBuffer");
  {
    const std::scoped_lock lock(counter.mutex);
    for (std::uint32_t i = 0; counter.isMapped(to) && i < count; ++i)
      counter.bytes += 4 * std::uint64_t{regions[i].imageExtent.width} * regions[i].imageExtent.height;
  }
  kNext(commands, image, layout, to, count, regions);
}
