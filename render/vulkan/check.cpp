#include "render/vulkan/check.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

namespace {

std::string_view remedy(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "enough memory; use a smaller image (--width, --height) or scene, or end other programs";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "enough device memory; use a smaller image (--width, --height) or scene, another device (--device), or "
             "--backend embree";
    case VK_ERROR_DEVICE_LOST:
      return "a device that completes its work; use a smaller image or region, another device (--device) or a newer "
             "driver";
    default:
      return "a working Vulkan driver; update it, or use another device (--device) or --backend embree";
  }
}

}  // namespace

std::string resultName(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "out of pool memory";
    case VK_ERROR_FRAGMENTED_POOL:
      return "fragmented pool";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialization failed";
    case VK_ERROR_DEVICE_LOST:
      return "device lost";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "memory map failed";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "layer not present";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "extension not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "feature not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "incompatible driver";
    default:
      return fmt::format("VkResult {}", static_cast<int>(result));
  }
}

void check(VkResult result, std::string_view step) {
  if (result != VK_SUCCESS) throw Error("Vulkan", fmt::format("{} failed", step), remedy(result), resultName(result));
}

}  // namespace malus::vulkan
