#include "render/vulkan/device_functions.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

DeviceFunctions loadDeviceFunctions(VkDevice device, bool statistics) {
  DeviceFunctions result;
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(vkGetDeviceProcAddr(device, name));
    if (!function)
      throw Error("Vulkan", fmt::format("the driver lacks the function {}", name),
                  "a newer driver, another device (--device) or --backend embree");
  };
#define MALUS_LOAD(member, function) load(result.member, #function);
  MALUS_DEVICE_FUNCTIONS(MALUS_LOAD)
  if (statistics) {
    MALUS_STATISTICS_FUNCTIONS(MALUS_LOAD)
  }
#undef MALUS_LOAD
  return result;
}

}  // namespace malus::vulkan
