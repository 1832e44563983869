#include "render/vulkan/device.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/vulkan/device_features.h"

namespace malus::vulkan {

namespace {

// A command buffer for one submission.
class Commands {
 public:
  Commands(VkDevice device, VkCommandPool pool, std::string_view purpose) : device_(device), pool_(pool) {
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device, &info, &commands_), fmt::format("vkAllocateCommandBuffers ({})", purpose));
  }
  ~Commands() { vkFreeCommandBuffers(device_, pool_, 1, &commands_); }
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  const VkCommandBuffer& get() const { return commands_; }

 private:
  VkDevice device_;
  VkCommandPool pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace

Device::Device(const Instance& instance, const std::string& wanted, bool statistics)
    : physical_(choosePhysicalDevice(instance, wanted)) {
  readProperties();
  const std::uint32_t queueFamily = findQueueFamily();
  createDevice(queueFamily,
               statistics && hasExtension(physical_.handle, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME));
  vkGetDeviceQueue(get(), queueFamily, 0, &queue_);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = queueFamily;
  pool_ = create(get(), vkCreateCommandPool, pool, vkDestroyCommandPool, "vkCreateCommandPool");
}

void Device::readProperties() {
  vkGetPhysicalDeviceMemoryProperties(physical_.handle, &memory_);
  rayTracing_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
  VkPhysicalDeviceAccelerationStructurePropertiesKHR acceleration{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
  rayTracing_.pNext = &acceleration;
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  properties.pNext = &rayTracing_;
  vkGetPhysicalDeviceProperties2(physical_.handle, &properties);
  rayTracing_.pNext = nullptr;
  maxStorageBufferBytes_ = properties.properties.limits.maxStorageBufferRange;
  timestampPeriodNs_ = static_cast<double>(properties.properties.limits.timestampPeriod);
  scratchAlignment_ = std::max(1u, acceleration.minAccelerationStructureScratchOffsetAlignment);
  hasRayQueries_ = hasExtension(physical_.handle, VK_KHR_RAY_QUERY_EXTENSION_NAME);
}

// Ray tracing needs a queue for compute work. Its timestamps may be missing.
std::uint32_t Device::findQueueFamily() {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_.handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_.handle, &count, families.data());
  const auto family = std::find_if(families.begin(), families.end(),
                                   [](const auto& f) { return (f.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; });
  if (family == families.end())
    throw Error("Vulkan", fmt::format("device '{}' has no compute queue", physical_.name),
                "another device from 'malus --list-devices' (--device) or --backend embree");
  if (family->timestampValidBits == 0) timestampPeriodNs_ = 0;
  return static_cast<std::uint32_t>(family - families.begin());
}

void Device::createDevice(std::uint32_t queueFamily, bool statistics) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = queueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;

  DeviceFeatures features;
  features.pipeline.rayTracingPipeline = VK_TRUE;
  features.acceleration.accelerationStructure = VK_TRUE;
  features.core12.bufferDeviceAddress = VK_TRUE;
  features.core12.scalarBlockLayout = VK_TRUE;
  std::vector<const char*> extensions = requiredExtensions();
  if (statistics) {
    extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    features.executables.pipelineExecutableInfo = VK_TRUE;
    features.append(features.executables);
  }
  if (hasRayQueries_) {
    extensions.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    features.queries.rayQuery = VK_TRUE;
    features.append(features.queries);
  }

  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features.all;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkDevice device = VK_NULL_HANDLE;
  check(vkCreateDevice(physical_.handle, &info, nullptr, &device), "vkCreateDevice");
  device_.reset(device);
  functions_ = loadDeviceFunctions(device, statistics);
}

std::uint32_t Device::maxDepth() const {
  const std::uint32_t limit = rayTracing_.maxRayRecursionDepth;
  return limit < 2 ? 0 : limit - 2;
}

void Device::requireDepth(std::uint32_t depth) const {
  if (depth > maxDepth())
    throw Error("--depth", fmt::format("exceeds the recursion limit of device '{}'", physical_.name),
                fmt::format("at most {}, or an iterative method (--method), which has no such limit", maxDepth()),
                fmt::format("{}", depth));
}

std::uint32_t Device::findMemoryType(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const {
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
    if ((allowed & (1u << i)) != 0 && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  throw Error("Vulkan", fmt::format("device '{}' has no memory type with property flags {:#x}", physical_.name, wanted),
              "another device from 'malus --list-devices' (--device) or --backend embree");
}

void Device::submit(std::string_view purpose, const std::function<void(VkCommandBuffer)>& record) const {
  const auto step = [&](const char* function) { return fmt::format("{} ({})", function, purpose); };
  const Commands commands(get(), pool_.get(), purpose);
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands.get(), &begin), step("vkBeginCommandBuffer"));
  record(commands.get());
  check(vkEndCommandBuffer(commands.get()), step("vkEndCommandBuffer"));
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands.get();
  check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), step("vkQueueSubmit"));
  check(vkQueueWaitIdle(queue_), step("vkQueueWaitIdle"));
}

}  // namespace malus::vulkan
