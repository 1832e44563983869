#include "render/vulkan/device_description.h"

#include <algorithm>

#include <fmt/format.h>

#include "render/vulkan/instance.h"
#include "render/vulkan/physical_device.h"
#include "render/vulkan/ray_tracing_cores.h"

namespace malus::vulkan {

namespace {

const char* typeName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "CPU";
    default:
      return "other";
  }
}

DeviceDescription describe(const PhysicalDevice& d) {
  const std::uint32_t version = d.capabilities.apiVersion;
  return {d.name,
          d.driver,
          d.problem,
          false,
          typeName(d.type),
          rayTracingCores(d.type, d.capabilities.vendorID, d.name),
          fmt::format("{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version)),
          listValues(d.capabilities)};
}

}  // namespace

std::vector<DeviceDescription> devices() {
  const Instance instance(0);
  const std::vector<PhysicalDevice> list = listPhysicalDevices(instance);
  const PhysicalDevice* const byDefault = findDefaultDevice(list);
  std::vector<DeviceDescription> result;
  result.reserve(list.size());
  for (const PhysicalDevice& d : list) {
    result.push_back(describe(d));
    result.back().isDefault = &d == byDefault;
  }
  return result;
}

DeviceDescription chosenDevice(const std::string& wanted) {
  const Instance instance(0);
  return describe(choosePhysicalDevice(instance, wanted));
}

nlohmann::json toJson(const DeviceDescription& d) {
  nlohmann::json values = nlohmann::json::object();
  for (const auto& [name, value] : d.values) values[name] = value;
  return {{"name", d.name},
          {"driver", d.driver},
          {"problem", d.problem.empty() ? nlohmann::json() : nlohmann::json(d.problem)},
          {"type", d.type},
          {"rayTracingCores", d.rayTracingCores},
          {"vulkan", d.vulkan},
          {"values", values}};
}

}  // namespace malus::vulkan
