#include "render/vulkan/device.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/vulkan/check.h"

namespace malus::vulkan {

namespace {

constexpr std::array kExtensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                    VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
                                    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

// The features that the renderer uses, chained.
struct Features {
  VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
  VkPhysicalDeviceVulkan12Features core12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceRayQueryFeaturesKHR queries{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executables{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR};
  VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  Features() {
    all.pNext = &core12;
    core12.pNext = &acceleration;
    acceleration.pNext = &pipeline;
  }
  Features(const Features&) = delete;
};

std::vector<std::string> extensionsOf(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  std::vector<std::string> names;
  for (const VkExtensionProperties& e : extensions) names.emplace_back(e.extensionName);
  return names;
}

bool contains(const std::vector<std::string>& names, std::string_view wanted) {
  return std::find(names.begin(), names.end(), wanted) != names.end();
}

std::string problemOf(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
  if (properties.apiVersion < VK_API_VERSION_1_2) return "Vulkan older than 1.2";
  const std::vector<std::string> extensions = extensionsOf(device);
  for (const char* wanted : kExtensions)
    if (!contains(extensions, wanted)) return fmt::format("no ray tracing ({} is missing)", wanted);
  Features features;
  vkGetPhysicalDeviceFeatures2(device, &features.all);
  if (!features.pipeline.rayTracingPipeline || !features.acceleration.accelerationStructure)
    return "ray tracing is not enabled";
  if (!features.core12.bufferDeviceAddress || !features.core12.scalarBlockLayout)
    return "no buffer addresses or scalar layout";
  return {};
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    default:
      return 3;
  }
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

PhysicalDevice choose(const Instance& instance, std::string wanted) {
  const std::vector<PhysicalDevice> devices = describeDevices(instance);
  const char* const kExpected =
      "a device with ray-tracing pipelines, such as Mesa's lavapipe (mesa-vulkan-drivers 24.3 or later)";
  if (devices.empty()) throw Error("Vulkan", "no device", kExpected);
  if (wanted.empty())
    if (const char* variable = std::getenv("MALUS_DEVICE")) wanted = variable;
  std::optional<PhysicalDevice> found;
  if (!wanted.empty()) {
    const bool number =
        std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c) != 0; }) &&
        wanted.size() < 6;
    for (std::size_t i = 0; i < devices.size() && !found; ++i)
      if (number ? std::stoul(wanted) == i
                 : lower(devices[i].name + " " + devices[i].driver).find(lower(wanted)) != std::string::npos)
        found = devices[i];
    if (!found)
      throw Error("Vulkan", fmt::format("no device '{}'", wanted),
                  "a number or part of a name from 'malus --list-devices'");
  } else {
    for (const PhysicalDevice& device : devices)
      if (device.problem.empty() && (!found || rank(device.type) < rank(found->type))) found = device;
    if (!found) found = devices.front();
  }
  if (!found->problem.empty())
    throw Error("Vulkan", fmt::format("device '{}' cannot be used: {}", found->name, found->problem), kExpected);
  return *found;
}

}  // namespace

std::vector<PhysicalDevice> describeDevices(const Instance& instance) {
  std::vector<PhysicalDevice> result;
  for (VkPhysicalDevice handle : instance.physicalDevices()) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(handle, &properties);
    result.push_back({handle, properties.properties.deviceName,
                      fmt::format("{} {}", driver.driverName, driver.driverInfo),
                      problemOf(handle, properties.properties), properties.properties.deviceType});
  }
  return result;
}

Device::Device(const Instance& instance, const std::string& wanted, bool statistics)
    : physical_(choose(instance, wanted)) {
  VkPhysicalDevice physical = physical_.handle;
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
  rayTracing_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
  VkPhysicalDeviceAccelerationStructurePropertiesKHR acceleration{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
  rayTracing_.pNext = &acceleration;
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  properties.pNext = &rayTracing_;
  vkGetPhysicalDeviceProperties2(physical, &properties);
  rayTracing_.pNext = nullptr;
  maxStorageBufferBytes_ = properties.properties.limits.maxStorageBufferRange;
  scratchAlignment_ = std::max(1u, acceleration.minAccelerationStructureScratchOffsetAlignment);

  // A queue that computes; ray tracing needs no more.
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  const auto family = std::find_if(families.begin(), families.end(),
                                   [](const auto& f) { return (f.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; });
  if (family == families.end()) throw Error("Vulkan", fmt::format("device '{}' has no compute queue", physical_.name));
  if (family->timestampValidBits > 0)
    timestampPeriodNs_ = static_cast<double>(properties.properties.limits.timestampPeriod);

  const float priority = 1;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = static_cast<std::uint32_t>(family - families.begin());
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  Features features;
  features.pipeline.rayTracingPipeline = VK_TRUE;
  features.acceleration.accelerationStructure = VK_TRUE;
  features.core12.bufferDeviceAddress = VK_TRUE;
  features.core12.scalarBlockLayout = VK_TRUE;
  std::vector<const char*> extensions(kExtensions.begin(), kExtensions.end());
  statistics = statistics && contains(extensionsOf(physical), VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
  const auto add = [&](const char* extension, auto& feature) {
    extensions.push_back(extension);
    feature.pNext = features.pipeline.pNext;
    features.pipeline.pNext = &feature;
  };
  if (statistics) {
    add(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME, features.executables);
    features.executables.pipelineExecutableInfo = VK_TRUE;
  }
  // The methods that loop.
  rayQueries_ = contains(extensionsOf(physical), VK_KHR_RAY_QUERY_EXTENSION_NAME);
  if (rayQueries_) {
    add(VK_KHR_RAY_QUERY_EXTENSION_NAME, features.queries);
    features.queries.rayQuery = VK_TRUE;
  }
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features.all;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateDevice(physical, &info, nullptr, &device_), "vkCreateDevice");
  vkGetDeviceQueue(device_, queue.queueFamilyIndex, 0, &queue_);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = queue.queueFamilyIndex;
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");

  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(vkGetDeviceProcAddr(device_, name));
    if (!function) throw Error("Vulkan", fmt::format("the driver has no {}", name));
  };
  load(getBufferDeviceAddress, "vkGetBufferDeviceAddress");
  load(createAccelerationStructure, "vkCreateAccelerationStructureKHR");
  load(destroyAccelerationStructure, "vkDestroyAccelerationStructureKHR");
  load(getAccelerationStructureBuildSizes, "vkGetAccelerationStructureBuildSizesKHR");
  load(getAccelerationStructureDeviceAddress, "vkGetAccelerationStructureDeviceAddressKHR");
  load(cmdBuildAccelerationStructures, "vkCmdBuildAccelerationStructuresKHR");
  load(createRayTracingPipelines, "vkCreateRayTracingPipelinesKHR");
  load(getRayTracingShaderGroupHandles, "vkGetRayTracingShaderGroupHandlesKHR");
  load(cmdTraceRays, "vkCmdTraceRaysKHR");
  load(getRayTracingShaderGroupStackSize, "vkGetRayTracingShaderGroupStackSizeKHR");
  if (statistics) {
    load(getPipelineExecutableProperties, "vkGetPipelineExecutablePropertiesKHR");
    load(getPipelineExecutableStatistics, "vkGetPipelineExecutableStatisticsKHR");
  }
}

Device::~Device() {
  if (pool_) vkDestroyCommandPool(device_, pool_, nullptr);
  if (device_) vkDestroyDevice(device_, nullptr);
}

std::uint32_t Device::memoryType(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const {
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
    if ((allowed & (1u << i)) != 0 && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  throw Error("Vulkan", fmt::format("device '{}' has no memory of the wanted type", physical_.name));
}

void Device::submit(const std::function<void(VkCommandBuffer)>& record) const {
  VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate.commandPool = pool_;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &allocate, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  record(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  const VkResult submitted = vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE);
  const VkResult waited = submitted == VK_SUCCESS ? vkQueueWaitIdle(queue_) : submitted;
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
  check(submitted, "vkQueueSubmit");
  check(waited, "vkQueueWaitIdle");
}

}  // namespace malus::vulkan
