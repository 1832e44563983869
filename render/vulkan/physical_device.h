// The Vulkan devices of this machine, and the choice of one for ray tracing.
#pragma once

#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "render/vulkan/capabilities.h"
#include "render/vulkan/instance.h"

namespace malus::vulkan {

struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  std::string name;
  std::string driver;   // "llvmpipe Mesa 25.0.7"
  std::string problem;  // "missing extension VK_KHR_ray_tracing_pipeline"; empty: usable
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  Capabilities capabilities;
};

// At least one, in the order in which the loader enumerates them, which numbers them for --device. Throws Error: none.
std::vector<PhysicalDevice> listPhysicalDevices(const Instance& instance);

// wanted: a number or a part of a name (case is ignored); empty: the value of MALUS_DEVICE, otherwise the first usable
// discrete GPU, otherwise an integrated, a virtual GPU, a CPU. Throws Error: no device, no such device, not usable.
PhysicalDevice choosePhysicalDevice(const Instance& instance, const std::string& wanted);

// The usable device of the list that is chosen without --device; null: none, or MALUS_DEVICE names another.
const PhysicalDevice* findDefaultDevice(const std::vector<PhysicalDevice>& devices);

// The order of preference of types of devices: the smallest is the best.
int typeRank(VkPhysicalDeviceType type);

// Extensions that every device must have.
const std::vector<const char*>& requiredExtensions();

}  // namespace malus::vulkan
