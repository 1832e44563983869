#include "render/vulkan/capabilities.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/vulkan/check.h"
#include "render/vulkan/device_features.h"

namespace malus::vulkan {

namespace {

constexpr const char* kVariable = "MALUS_VULKAN_LIMITS";
constexpr std::string_view kMemoryHeapSize = "memoryHeapSize";

// Extensions that decisions depend on.
constexpr std::string_view kExtensions[] = {VK_EXT_MEMORY_BUDGET_EXTENSION_NAME,
                                            VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                            VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
                                            VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME,
                                            VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME,
                                            VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                            VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME};

struct Feature {
  std::string_view name;
  bool Capabilities::*member;
};
constexpr Feature kFeatures[] = {
    {"rayTracingPipeline", &Capabilities::rayTracingPipeline},
    {"accelerationStructure", &Capabilities::accelerationStructure},
    {"bufferDeviceAddress", &Capabilities::bufferDeviceAddress},
    {"scalarBlockLayout", &Capabilities::scalarBlockLayout},
    {"rayQuery", &Capabilities::rayQuery},
    {"pipelineExecutableInfo", &Capabilities::pipelineExecutableInfo},
};

struct Limit {
  std::string_view name;
  std::uint64_t Capabilities::*member;
  bool isAlignment;  // stricter if larger
};
constexpr Limit kLimits[] = {
    {"maxStorageBufferRange", &Capabilities::maxStorageBufferRange, false},
    {"maxMemoryAllocationSize", &Capabilities::maxMemoryAllocationSize, false},
    {"maxRayRecursionDepth", &Capabilities::maxRayRecursionDepth, false},
    {"maxRayDispatchInvocationCount", &Capabilities::maxRayDispatchInvocationCount, false},
    {"maxGeometryCount", &Capabilities::maxGeometryCount, false},
    {"maxPrimitiveCount", &Capabilities::maxPrimitiveCount, false},
    {"shaderGroupHandleAlignment", &Capabilities::shaderGroupHandleAlignment, true},
    {"shaderGroupBaseAlignment", &Capabilities::shaderGroupBaseAlignment, true},
    {"minAccelerationStructureScratchOffsetAlignment", &Capabilities::minAccelerationStructureScratchOffsetAlignment,
     true},
    {"timestampValidBits", &Capabilities::timestampValidBits, false},
};

void readExtensions(VkPhysicalDevice device, Capabilities& result) {
  std::uint32_t count = 0;
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), "vkEnumerateDeviceExtensionProperties");
  std::vector<VkExtensionProperties> extensions(count);
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
        "vkEnumerateDeviceExtensionProperties");
  extensions.resize(count);
  for (const VkExtensionProperties& e : extensions) result.extensions.emplace_back(e.extensionName);
}

void readFeatures(VkPhysicalDevice device, Capabilities& result) {
  DeviceFeatures features;
  if (result.has(VK_KHR_RAY_QUERY_EXTENSION_NAME)) features.append(features.queries);
  if (result.has(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME)) features.append(features.executables);
  vkGetPhysicalDeviceFeatures2(device, &features.all);
  result.rayTracingPipeline = features.pipeline.rayTracingPipeline != 0;
  result.accelerationStructure = features.acceleration.accelerationStructure != 0;
  result.bufferDeviceAddress = features.core12.bufferDeviceAddress != 0;
  result.scalarBlockLayout = features.core12.scalarBlockLayout != 0;
  result.rayQuery = features.queries.rayQuery != 0;
  result.pipelineExecutableInfo = features.executables.pipelineExecutableInfo != 0;
}

void readLimits(VkPhysicalDevice device, Capabilities& result) {
  VkPhysicalDeviceIDProperties identity{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
  VkPhysicalDeviceMaintenance3Properties allocation{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES,
                                                    &identity};
  VkPhysicalDeviceAccelerationStructurePropertiesKHR acceleration{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR, &allocation};
  VkPhysicalDeviceRayTracingPipelinePropertiesKHR pipeline{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR, &acceleration};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &pipeline};
  vkGetPhysicalDeviceProperties2(device, &properties);
  const VkPhysicalDeviceProperties& core = properties.properties;
  result.maxStorageBufferRange = core.limits.maxStorageBufferRange;
  result.timestampPeriod = static_cast<double>(core.limits.timestampPeriod);
  result.vendorID = core.vendorID;
  result.deviceID = core.deviceID;
  result.driverVersion = core.driverVersion;
  std::copy_n(core.pipelineCacheUUID, VK_UUID_SIZE, result.pipelineCacheUUID.begin());
  std::copy_n(identity.deviceUUID, VK_UUID_SIZE, result.deviceUUID.begin());
  std::copy_n(identity.driverUUID, VK_UUID_SIZE, result.driverUUID.begin());
  result.maxMemoryAllocationSize = allocation.maxMemoryAllocationSize;
  result.maxGeometryCount = acceleration.maxGeometryCount;
  result.maxPrimitiveCount = acceleration.maxPrimitiveCount;
  result.minAccelerationStructureScratchOffsetAlignment =
      std::max(1u, acceleration.minAccelerationStructureScratchOffsetAlignment);
  result.maxRayRecursionDepth = pipeline.maxRayRecursionDepth;
  result.maxRayDispatchInvocationCount = pipeline.maxRayDispatchInvocationCount;
  result.shaderGroupHandleSize = pipeline.shaderGroupHandleSize;
  result.shaderGroupHandleAlignment = std::max(1u, pipeline.shaderGroupHandleAlignment);
  result.shaderGroupBaseAlignment = std::max(1u, pipeline.shaderGroupBaseAlignment);
}

void readQueues(VkPhysicalDevice device, Capabilities& result) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  const auto family = std::find_if(families.begin(), families.end(),
                                   [](const auto& f) { return (f.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; });
  if (family == families.end()) return;
  result.hasComputeQueue = true;
  result.queueFamily = static_cast<std::uint32_t>(family - families.begin());
  result.timestampValidBits = family->timestampValidBits;
}

struct Setting {
  std::string_view name;
  std::uint64_t value = 0;
};

// Calls use(setting) for each NAME=VALUE of the list. Throws Error: not of this form.
template <typename Use>
void forEachSetting(std::string_view list, const Use& use) {
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    const std::string_view text = list.substr(at, end - at);
    const std::size_t equals = std::min(text.find('='), text.size());
    Setting setting{text.substr(0, equals)};
    const std::string_view value = text.substr(std::min(equals + 1, text.size()));
    const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), setting.value);
    if (error != std::errc() || rest != value.data() + value.size())
      throw Error(kVariable, "invalid setting", "NAME=VALUE with an unsigned integer", fmt::format("'{}'", text));
    use(setting);
    at = end + 1;
  }
}

void requireZero(const Setting& setting) {
  if (setting.value != 0)
    throw Error(kVariable, fmt::format("'{}' can only be hidden", setting.name), "0", fmt::format("{}", setting.value));
}

bool isExtension(std::string_view name) {
  return std::find(std::begin(kExtensions), std::end(kExtensions), name) != std::end(kExtensions);
}

[[noreturn]] void rejectName(std::string_view name) {
  std::vector<std::string_view> names(std::begin(kExtensions), std::end(kExtensions));
  for (const Feature& feature : kFeatures) names.push_back(feature.name);
  for (const Limit& limit : kLimits) names.push_back(limit.name);
  names.push_back(kMemoryHeapSize);
  throw Error(kVariable, "unknown name", fmt::format("one of {}", fmt::join(names, ", ")), fmt::format("'{}'", name));
}

void applySetting(Capabilities& capabilities, const Setting& setting) {
  for (const Feature& feature : kFeatures)
    if (feature.name == setting.name) {
      requireZero(setting);
      capabilities.*feature.member = false;
      return;
    }
  for (const Limit& limit : kLimits)
    if (limit.name == setting.name) {
      std::uint64_t& value = capabilities.*limit.member;
      value = limit.isAlignment ? std::max(value, setting.value) : std::min(value, setting.value);
      return;
    }
  if (setting.name != kMemoryHeapSize) rejectName(setting.name);
  VkPhysicalDeviceMemoryProperties& memory = capabilities.memory;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    memory.memoryHeaps[i].size = std::min<VkDeviceSize>(memory.memoryHeaps[i].size, setting.value);
}

std::string_view limitsFromEnvironment() {
  const char* const text = std::getenv(kVariable);
  return text ? text : "";
}

}  // namespace

bool Capabilities::has(std::string_view extension) const {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

std::vector<std::pair<std::string, std::uint64_t>> listValues(const Capabilities& capabilities) {
  std::vector<std::pair<std::string, std::uint64_t>> list;
  for (const Feature& feature : kFeatures) list.emplace_back(feature.name, capabilities.*feature.member ? 1 : 0);
  for (const Limit& limit : kLimits) list.emplace_back(limit.name, capabilities.*limit.member);
  VkDeviceSize largest = 0;
  for (std::uint32_t i = 0; i < capabilities.memory.memoryHeapCount; ++i)
    if ((capabilities.memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
      largest = std::max(largest, capabilities.memory.memoryHeaps[i].size);
  list.emplace_back(kMemoryHeapSize, largest);
  return list;
}

Capabilities readCapabilities(VkPhysicalDevice device) {
  const std::string_view limits = limitsFromEnvironment();
  Capabilities result;
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  result.apiVersion = properties.apiVersion;
  if (result.apiVersion < VK_API_VERSION_1_2) return result;
  readExtensions(device, result);
  // The features of an extension follow from its presence.
  forEachSetting(limits, [&](const Setting& setting) {
    if (!isExtension(setting.name)) return;
    requireZero(setting);
    std::erase(result.extensions, setting.name);
  });
  readFeatures(device, result);
  readLimits(device, result);
  readQueues(device, result);
  vkGetPhysicalDeviceMemoryProperties(device, &result.memory);
  forEachSetting(limits, [&](const Setting& setting) {
    if (!isExtension(setting.name)) applySetting(result, setting);
  });
  return result;
}

}  // namespace malus::vulkan
