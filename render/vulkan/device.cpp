#include "render/vulkan/device.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/vulkan/device_features.h"

namespace malus::vulkan {

Device::Device(const Instance& instance, const std::string& wanted, DeviceUse use)
    : physical_(choosePhysicalDevice(instance, wanted)) {
  importsMemory_ = use.importsMemory && capabilities().has(VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME);
  createDevice({use.statistics && capabilities().pipelineExecutableInfo, importsMemory_});
  vkGetDeviceQueue(get(), capabilities().queueFamily, 0, &queue_);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = capabilities().queueFamily;
  pool_ = create(get(), vkCreateCommandPool, pool, vkDestroyCommandPool, "vkCreateCommandPool");
  VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  commands.commandPool = pool_.get();
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(get(), &commands, &commands_), "vkAllocateCommandBuffers");
}

// use: that the device has.
void Device::createDevice(DeviceUse use) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = capabilities().queueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;

  DeviceFeatures features;
  features.pipeline.rayTracingPipeline = VK_TRUE;
  features.acceleration.accelerationStructure = VK_TRUE;
  features.core12.bufferDeviceAddress = VK_TRUE;
  features.core12.scalarBlockLayout = VK_TRUE;
  std::vector<const char*> extensions = requiredExtensions();
  if (use.importsMemory) extensions.push_back(VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME);
  if (use.statistics) {
    extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    features.executables.pipelineExecutableInfo = VK_TRUE;
    features.append(features.executables);
  }
  if (capabilities().rayQuery) {
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
  functions_ = loadDeviceFunctions(device, use.statistics);
}

void Device::submit(std::string_view purpose, const std::function<void(VkCommandBuffer)>& record) const {
  const auto step = [&](const char* function) { return fmt::format("{} ({})", function, purpose); };
  // A submission that failed may have left the buffer in the recording state.
  check(vkResetCommandPool(get(), pool_.get(), 0), step("vkResetCommandPool"));
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands_, &begin), step("vkBeginCommandBuffer"));
  record(commands_);
  // Waiting for the queue does not make writes of the device visible to the host, nor to later submissions.
  const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_MEMORY_WRITE_BIT,
                                VK_ACCESS_HOST_READ_BIT | VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
  vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                       nullptr);
  check(vkEndCommandBuffer(commands_), step("vkEndCommandBuffer"));
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), step("vkQueueSubmit"));
  check(vkQueueWaitIdle(queue_), step("vkQueueWaitIdle"));
}

}  // namespace malus::vulkan
