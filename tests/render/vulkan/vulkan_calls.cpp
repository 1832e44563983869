#include "tests/render/vulkan/vulkan_calls.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include <dlfcn.h>
#include <vulkan/vulkan.h>

// Hidden: neither the loader nor a layer may call these definitions.
#define WATCHED extern "C" __attribute__((visibility("hidden"))) VKAPI_ATTR

namespace malus::test {
namespace {

struct State {
  std::mutex mutex;
  std::size_t failAt = 0;
  VulkanCalls calls;
  PFN_vkDebugUtilsMessengerCallbackEXT callback = nullptr;  // the renderer's
  std::map<std::string, PFN_vkVoidFunction, std::less<>> extensions;
  std::optional<VkPhysicalDeviceMemoryProperties> memory;  // simulated
  std::uint64_t structurePadding = 0;
};
State& state() {
  static State instance;
  return instance;
}

// Whether this call shall fail.
bool fails(const char* function) {
  State& s = state();
  const std::lock_guard lock(s.mutex);
  if (++s.calls.fallible != s.failAt) return false;
  s.calls.failed = function;
  return true;
}

void count(const char* creator, int objects) {
  State& s = state();
  const std::lock_guard lock(s.mutex);
  if ((s.calls.live[creator] += objects) == 0) s.calls.live.erase(creator);
}

template <typename Function>
Function loaderFunction(const char* name) {
  static void* const kLoader = ::dlopen("libvulkan.so.1", RTLD_NOW);
  return reinterpret_cast<Function>(::dlsym(kLoader, name));
}

template <typename Function>
Function extensionFunction(const char* name) {
  return reinterpret_cast<Function>(state().extensions.at(name));
}

VKAPI_ATTR VkBool32 VKAPI_CALL keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                           VkDebugUtilsMessageTypeFlagsEXT types,
                                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  {
    const std::lock_guard lock(state().mutex);
    state().calls.messages.emplace_back(data->pMessage ? data->pMessage : "");
  }
  return state().callback(severity, types, data, user);
}

VkDebugUtilsMessengerCreateInfoEXT withOwnCallback(const VkDebugUtilsMessengerCreateInfoEXT& info) {
  VkDebugUtilsMessengerCreateInfoEXT result = info;
  state().callback = info.pfnUserCallback;
  result.pfnUserCallback = keepMessage;
  return result;
}

// Functions of extensions.
VKAPI_ATTR VkResult VKAPI_CALL createMessenger(VkInstance instance, const VkDebugUtilsMessengerCreateInfoEXT* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkDebugUtilsMessengerEXT* messenger) {
  constexpr const char* kName = "vkCreateDebugUtilsMessengerEXT";
  if (fails(kName)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkDebugUtilsMessengerCreateInfoEXT own = withOwnCallback(*info);
  const VkResult result =
      extensionFunction<PFN_vkCreateDebugUtilsMessengerEXT>(kName)(instance, &own, allocator, messenger);
  if (result == VK_SUCCESS) count(kName, 1);
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger,
                                            const VkAllocationCallbacks* allocator) {
  if (messenger != VK_NULL_HANDLE) count("vkCreateDebugUtilsMessengerEXT", -1);
  extensionFunction<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(instance, messenger,
                                                                                            allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL createStructure(VkDevice device, const VkAccelerationStructureCreateInfoKHR* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkAccelerationStructureKHR* structure) {
  constexpr const char* kName = "vkCreateAccelerationStructureKHR";
  if (fails(kName)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result =
      extensionFunction<PFN_vkCreateAccelerationStructureKHR>(kName)(device, info, allocator, structure);
  if (result != VK_SUCCESS) return result;
  count(kName, 1);
  const std::lock_guard lock(state().mutex);
  state().calls.structureBytes.push_back(info->size);
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroyStructure(VkDevice device, VkAccelerationStructureKHR structure,
                                            const VkAllocationCallbacks* allocator) {
  if (structure != VK_NULL_HANDLE) count("vkCreateAccelerationStructureKHR", -1);
  extensionFunction<PFN_vkDestroyAccelerationStructureKHR>("vkDestroyAccelerationStructureKHR")(device, structure,
                                                                                                allocator);
}

VKAPI_ATTR void VKAPI_CALL getBuildSizes(VkDevice device, VkAccelerationStructureBuildTypeKHR type,
                                         const VkAccelerationStructureBuildGeometryInfoKHR* info,
                                         const std::uint32_t* counts, VkAccelerationStructureBuildSizesInfoKHR* sizes) {
  extensionFunction<PFN_vkGetAccelerationStructureBuildSizesKHR>("vkGetAccelerationStructureBuildSizesKHR")(
      device, type, info, counts, sizes);
  sizes->accelerationStructureSize += state().structurePadding;
}

VKAPI_ATTR void VKAPI_CALL copyStructure(VkCommandBuffer commands, const VkCopyAccelerationStructureInfoKHR* info) {
  {
    const std::lock_guard lock(state().mutex);
    if (info->mode == VK_COPY_ACCELERATION_STRUCTURE_MODE_COMPACT_KHR) ++state().calls.compactions;
  }
  extensionFunction<PFN_vkCmdCopyAccelerationStructureKHR>("vkCmdCopyAccelerationStructureKHR")(commands, info);
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkDeferredOperationKHR operation, VkPipelineCache cache,
                                               std::uint32_t number, const VkRayTracingPipelineCreateInfoKHR* infos,
                                               const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  constexpr const char* kName = "vkCreateRayTracingPipelinesKHR";
  if (fails(kName)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result = extensionFunction<PFN_vkCreateRayTracingPipelinesKHR>(kName)(device, operation, cache, number,
                                                                                       infos, allocator, pipelines);
  if (result != VK_SUCCESS) return result;
  count(kName, static_cast<int>(number));
  const std::lock_guard lock(state().mutex);
  state().calls.pipelineThreads.push_back(std::this_thread::get_id());
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL getGroupHandles(VkDevice device, VkPipeline pipeline, std::uint32_t first,
                                               std::uint32_t number, std::size_t bytes, void* data) {
  constexpr const char* kName = "vkGetRayTracingShaderGroupHandlesKHR";
  if (fails(kName)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  return extensionFunction<PFN_vkGetRayTracingShaderGroupHandlesKHR>(kName)(device, pipeline, first, number, bytes,
                                                                            data);
}

// The watched function in place of one of an extension.
PFN_vkVoidFunction substitute(const char* name, PFN_vkVoidFunction real) {
  if (!real) return real;
  static const std::map<std::string_view, PFN_vkVoidFunction> kWatched = {
      {"vkCreateDebugUtilsMessengerEXT", reinterpret_cast<PFN_vkVoidFunction>(createMessenger)},
      {"vkDestroyDebugUtilsMessengerEXT", reinterpret_cast<PFN_vkVoidFunction>(destroyMessenger)},
      {"vkCreateAccelerationStructureKHR", reinterpret_cast<PFN_vkVoidFunction>(createStructure)},
      {"vkDestroyAccelerationStructureKHR", reinterpret_cast<PFN_vkVoidFunction>(destroyStructure)},
      {"vkGetAccelerationStructureBuildSizesKHR", reinterpret_cast<PFN_vkVoidFunction>(getBuildSizes)},
      {"vkCmdCopyAccelerationStructureKHR", reinterpret_cast<PFN_vkVoidFunction>(copyStructure)},
      {"vkCreateRayTracingPipelinesKHR", reinterpret_cast<PFN_vkVoidFunction>(createPipelines)},
      {"vkGetRayTracingShaderGroupHandlesKHR", reinterpret_cast<PFN_vkVoidFunction>(getGroupHandles)}};
  State& s = state();
  const std::lock_guard lock(s.mutex);
  s.extensions[name] = real;
  if (const auto found = kWatched.find(name); found != kWatched.end()) return found->second;
  if (std::strncmp(name, "vkCreate", 8) == 0 || std::strncmp(name, "vkAllocate", 10) == 0)
    s.calls.unwatched.emplace_back(name);
  return real;
}

}  // namespace

void watchVulkanCalls(std::size_t failAt) {
  const std::lock_guard lock(state().mutex);
  state().failAt = failAt;
  state().calls = {};
}

void simulateMemory(const std::array<std::uint64_t, 3>& sizes) {
  constexpr VkMemoryPropertyFlags kLocalFlag = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                  kHostFlags =
                                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkPhysicalDeviceMemoryProperties memory{};
  memory.memoryTypeCount = 4;
  memory.memoryTypes[kLocal] = {kLocalFlag, kLocalHeap};
  memory.memoryTypes[kHost] = {kHostFlags, kHostHeap};
  memory.memoryTypes[kHostCached] = {kHostFlags | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kHostHeap};
  memory.memoryTypes[kLocalHost] = {kLocalFlag | kHostFlags, kLocalHostHeap};
  memory.memoryHeapCount = static_cast<std::uint32_t>(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) memory.memoryHeaps[i].size = sizes[i];
  const std::lock_guard lock(state().mutex);
  state().memory = memory;
}

void padStructures(std::uint64_t bytes) {
  const std::lock_guard lock(state().mutex);
  state().structurePadding = bytes;
}

void endSimulatedMemory() {
  const std::lock_guard lock(state().mutex);
  state().memory.reset();
}

VulkanCalls vulkanCalls() {
  const std::lock_guard lock(state().mutex);
  return state().calls;
}

}  // namespace malus::test

using malus::test::count;
using malus::test::fails;
using malus::test::loaderFunction;
using malus::test::state;

WATCHED PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  return malus::test::substitute(name,
                                 loaderFunction<PFN_vkGetInstanceProcAddr>("vkGetInstanceProcAddr")(instance, name));
}

WATCHED PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name) {
  return malus::test::substitute(name, loaderFunction<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr")(device, name));
}

WATCHED VkResult VKAPI_CALL vkCreateInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                             VkInstance* instance) {
  if (fails("vkCreateInstance")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  VkInstanceCreateInfo own = *info;
  VkDebugUtilsMessengerCreateInfoEXT messenger;
  if (own.pNext) {
    messenger = malus::test::withOwnCallback(*static_cast<const VkDebugUtilsMessengerCreateInfoEXT*>(own.pNext));
    own.pNext = &messenger;
  }
  const VkResult result = loaderFunction<PFN_vkCreateInstance>("vkCreateInstance")(&own, allocator, instance);
  if (result == VK_SUCCESS) count("vkCreateInstance", 1);
  return result;
}

WATCHED void VKAPI_CALL vkDestroyInstance(VkInstance instance, const VkAllocationCallbacks* allocator) {
  if (instance) count("vkCreateInstance", -1);
  loaderFunction<PFN_vkDestroyInstance>("vkDestroyInstance")(instance, allocator);
}

WATCHED VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                           const VkAllocationCallbacks* allocator, VkDevice* device) {
  if (fails("vkCreateDevice")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result = loaderFunction<PFN_vkCreateDevice>("vkCreateDevice")(physical, info, allocator, device);
  if (result == VK_SUCCESS) count("vkCreateDevice", 1);
  return result;
}

WATCHED void VKAPI_CALL vkDestroyDevice(VkDevice device, const VkAllocationCallbacks* allocator) {
  if (device) count("vkCreateDevice", -1);
  loaderFunction<PFN_vkDestroyDevice>("vkDestroyDevice")(device, allocator);
}

// Objects that a device creates.
#define WATCH_CREATE(creator, Info, Handle)                                                                      \
  WATCHED VkResult VKAPI_CALL creator(VkDevice device, const Info* info, const VkAllocationCallbacks* allocator, \
                                      Handle* object) {                                                          \
    if (fails(#creator)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;                                                   \
    const VkResult result = loaderFunction<PFN_##creator>(#creator)(device, info, allocator, object);            \
    if (result == VK_SUCCESS) count(#creator, 1);                                                                \
    return result;                                                                                               \
  }
#define WATCH_DESTROY(destroyer, creator, Handle)                                                             \
  WATCHED void VKAPI_CALL destroyer(VkDevice device, Handle object, const VkAllocationCallbacks* allocator) { \
    if (object != VK_NULL_HANDLE) count(creator, -1);                                                         \
    loaderFunction<PFN_##destroyer>(#destroyer)(device, object, allocator);                                   \
  }
WATCH_DESTROY(vkDestroyBuffer, "vkCreateBuffer", VkBuffer)
WATCH_DESTROY(vkFreeMemory, "vkAllocateMemory", VkDeviceMemory)
WATCH_CREATE(vkCreateCommandPool, VkCommandPoolCreateInfo, VkCommandPool)
WATCH_DESTROY(vkDestroyCommandPool, "vkCreateCommandPool", VkCommandPool)
WATCH_CREATE(vkCreateDescriptorSetLayout, VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout)
WATCH_DESTROY(vkDestroyDescriptorSetLayout, "vkCreateDescriptorSetLayout", VkDescriptorSetLayout)
WATCH_CREATE(vkCreateDescriptorPool, VkDescriptorPoolCreateInfo, VkDescriptorPool)
WATCH_DESTROY(vkDestroyDescriptorPool, "vkCreateDescriptorPool", VkDescriptorPool)
WATCH_CREATE(vkCreateQueryPool, VkQueryPoolCreateInfo, VkQueryPool)
WATCH_DESTROY(vkDestroyQueryPool, "vkCreateQueryPool", VkQueryPool)
WATCH_CREATE(vkCreateShaderModule, VkShaderModuleCreateInfo, VkShaderModule)
WATCH_DESTROY(vkDestroyShaderModule, "vkCreateShaderModule", VkShaderModule)
WATCH_CREATE(vkCreatePipelineLayout, VkPipelineLayoutCreateInfo, VkPipelineLayout)
WATCH_DESTROY(vkDestroyPipelineLayout, "vkCreatePipelineLayout", VkPipelineLayout)
WATCH_DESTROY(vkDestroyPipeline, "vkCreateRayTracingPipelinesKHR", VkPipeline)

WATCHED VkResult VKAPI_CALL vkCreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                                  const VkAllocationCallbacks* allocator, VkPipelineCache* cache) {
  if (fails("vkCreatePipelineCache")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result =
      loaderFunction<PFN_vkCreatePipelineCache>("vkCreatePipelineCache")(device, info, allocator, cache);
  if (result != VK_SUCCESS) return result;
  count("vkCreatePipelineCache", 1);
  const std::lock_guard lock(state().mutex);
  state().calls.pipelineCacheBytes.push_back(info->initialDataSize);
  return result;
}
WATCH_DESTROY(vkDestroyPipelineCache, "vkCreatePipelineCache", VkPipelineCache)

WATCHED VkResult VKAPI_CALL vkCreateBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                           const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
  if (fails("vkCreateBuffer")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result = loaderFunction<PFN_vkCreateBuffer>("vkCreateBuffer")(device, info, allocator, buffer);
  if (result != VK_SUCCESS) return result;
  count("vkCreateBuffer", 1);
  if (info->usage == VK_BUFFER_USAGE_TRANSFER_SRC_BIT) {
    const std::lock_guard lock(state().mutex);
    std::uint64_t& largest = state().calls.largestUpload;
    largest = std::max<std::uint64_t>(largest, info->size);
  }
  return result;
}

WATCHED void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties(VkPhysicalDevice device,
                                                            VkPhysicalDeviceMemoryProperties* properties) {
  loaderFunction<PFN_vkGetPhysicalDeviceMemoryProperties>("vkGetPhysicalDeviceMemoryProperties")(device, properties);
  if (state().memory) *properties = *state().memory;
}

WATCHED void VKAPI_CALL vkGetBufferMemoryRequirements(VkDevice device, VkBuffer buffer,
                                                      VkMemoryRequirements* requirements) {
  loaderFunction<PFN_vkGetBufferMemoryRequirements>("vkGetBufferMemoryRequirements")(device, buffer, requirements);
  requirements->size += state().structurePadding;  // the driver copies padded structures with their padding
  if (state().memory) requirements->memoryTypeBits = (1u << state().memory->memoryTypeCount) - 1;
}

WATCHED VkResult VKAPI_CALL vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
  if (fails("vkAllocateMemory")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  VkMemoryAllocateInfo own = *info;
  malus::test::State& s = state();
  if (s.memory) {
    const auto heap = [&](std::uint32_t type) { return s.memory->memoryTypes[type].heapIndex; };
    std::uint64_t used = info->allocationSize;
    for (const malus::test::Allocation& a : s.calls.allocations)
      if (heap(a.type) == heap(info->memoryTypeIndex)) used += a.bytes;
    if (used > s.memory->memoryHeaps[heap(info->memoryTypeIndex)].size) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    own.memoryTypeIndex = 0;
  }
  const VkResult result = loaderFunction<PFN_vkAllocateMemory>("vkAllocateMemory")(device, &own, allocator, memory);
  if (result != VK_SUCCESS) return result;
  count("vkAllocateMemory", 1);
  const std::lock_guard lock(s.mutex);
  s.calls.allocations.push_back({info->memoryTypeIndex, info->allocationSize});
  return result;
}

// Calls that can fail and leave nothing to destroy. Descriptor sets and command buffers are freed with
// their pool.
#define WATCH_CALL(function, parameters, arguments)             \
  WATCHED VkResult VKAPI_CALL function parameters {             \
    if (fails(#function)) return VK_ERROR_OUT_OF_DEVICE_MEMORY; \
    return loaderFunction<PFN_##function>(#function) arguments; \
  }
WATCH_CALL(vkAllocateDescriptorSets, (VkDevice device, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets),
           (device, info, sets))
WATCH_CALL(vkEnumeratePhysicalDevices, (VkInstance instance, std::uint32_t* number, VkPhysicalDevice* devices),
           (instance, number, devices))
WATCH_CALL(vkBindBufferMemory, (VkDevice device, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset),
           (device, buffer, memory, offset))
WATCH_CALL(vkMapMemory,
           (VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize bytes, VkMemoryMapFlags flags,
            void** data),
           (device, memory, offset, bytes, flags, data))
WATCH_CALL(vkResetCommandPool, (VkDevice device, VkCommandPool pool, VkCommandPoolResetFlags flags),
           (device, pool, flags))
WATCH_CALL(vkBeginCommandBuffer, (VkCommandBuffer commands, const VkCommandBufferBeginInfo* info), (commands, info))
WATCH_CALL(vkEndCommandBuffer, (VkCommandBuffer commands), (commands))
WATCH_CALL(vkAllocateCommandBuffers,
           (VkDevice device, const VkCommandBufferAllocateInfo* info, VkCommandBuffer* buffers),
           (device, info, buffers))
WATCHED VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, std::uint32_t number, const VkSubmitInfo* infos,
                                          VkFence fence) {
  if (fails("vkQueueSubmit")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  {
    const std::lock_guard lock(state().mutex);
    ++state().calls.submissions;
  }
  return loaderFunction<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, number, infos, fence);
}
WATCHED void VKAPI_CALL vkUpdateDescriptorSets(VkDevice device, std::uint32_t writes, const VkWriteDescriptorSet* write,
                                               std::uint32_t copies, const VkCopyDescriptorSet* copy) {
  {
    const std::lock_guard lock(state().mutex);
    ++state().calls.descriptorWrites;
  }
  loaderFunction<PFN_vkUpdateDescriptorSets>("vkUpdateDescriptorSets")(device, writes, write, copies, copy);
}
WATCHED VkResult VKAPI_CALL vkGetQueryPoolResults(VkDevice device, VkQueryPool pool, std::uint32_t first,
                                                  std::uint32_t number, std::size_t bytes, void* data,
                                                  VkDeviceSize stride, VkQueryResultFlags flags) {
  if (fails("vkGetQueryPoolResults")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result = loaderFunction<PFN_vkGetQueryPoolResults>("vkGetQueryPoolResults")(
      device, pool, first, number, bytes, data, stride, flags);
  // Two timestamps have 16 bytes, the compacted size of a structure 8.
  if (bytes == 8) *static_cast<std::uint64_t*>(data) -= state().structurePadding;
  return result;
}

WATCHED VkResult VKAPI_CALL vkQueueWaitIdle(VkQueue queue) {
  const VkResult result = loaderFunction<PFN_vkQueueWaitIdle>("vkQueueWaitIdle")(queue);
  return fails("vkQueueWaitIdle") ? VK_ERROR_OUT_OF_DEVICE_MEMORY : result;
}
