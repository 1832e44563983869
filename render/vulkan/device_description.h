// Descriptions of Vulkan devices for users: `malus devices`, `malus --list-devices` and the results of a comparison.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace malus::vulkan {

struct DeviceDescription {
  std::string name;
  std::string driver;
  std::string problem;          // empty: usable
  bool isDefault = false;       // chosen by an empty Options::device
  std::string type;             // "discrete GPU", "CPU", ...
  std::string rayTracingCores;  // "yes", "no" or "unknown" (ray_tracing_cores.h)
  std::string vulkan;           // version, "1.3"
  // Features (0 or 1), limits and memoryHeapSize [bytes] by the names of the Vulkan specification, as lowered by
  // MALUS_VULKAN_LIMITS.
  std::vector<std::pair<std::string, std::uint64_t>> values;
};

// All devices, in the order of their numbers for Options::device; at least one. Throws Error: no Vulkan driver, no
// device.
std::vector<DeviceDescription> devices();

// The device that a renderer with this Options::device uses. Throws as choosePhysicalDevice().
DeviceDescription chosenDevice(const std::string& wanted);

nlohmann::json toJson(const DeviceDescription& device);

}  // namespace malus::vulkan
