// Whether a device traverses acceleration structures in dedicated hardware. Vulkan has no property for it, and drivers
// offer ray tracing without it: times of such devices do not apply to those with it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <vulkan/vulkan.h>

namespace malus::vulkan {

// "yes", "no" or "unknown", by the type of the device, its vendor's number and its name. Known are CPUs and the GPUs of
// NVIDIA: its data sheets name RT cores for Turing RTX, Ampere, Ada and Blackwell GPUs except A100, A30 and the series
// H, GH, B and GB for data centres.
std::string rayTracingCores(VkPhysicalDeviceType type, std::uint32_t vendorID, std::string_view name);

}  // namespace malus::vulkan
