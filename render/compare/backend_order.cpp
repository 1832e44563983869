#include "render/compare/backend_order.h"

#include <algorithm>

#include "meshprep/base/error.h"
#include "render/vulkan/device_description.h"

namespace malus::render {

bool isOnCpu(Backend backend, const std::string& device) {
  if (backend != Backend::vulkan) return false;
  try {
    return vulkan::chosenDevice(device).type == "CPU";
  } catch (const Error&) {
    return false;
  }
}

std::vector<Backend> fastestToStartFirst(std::vector<Backend> backends, const std::string& device) {
  std::stable_partition(backends.begin(), backends.end(), [&](Backend backend) { return !isOnCpu(backend, device); });
  return backends;
}

}  // namespace malus::render
