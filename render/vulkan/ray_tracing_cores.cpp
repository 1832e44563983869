#include "render/vulkan/ray_tracing_cores.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace malus::vulkan {

namespace {

constexpr std::uint32_t kNvidia = 0x10DE;

// Models as words of the device's name: "NVIDIA H200", "NVIDIA A100-SXM4-80GB".
constexpr std::array kWithout = {"A100", "A30",  "A800", "H100",  "H200",  "H20",  "H800", "GH200",
                                 "B100", "B200", "B300", "GB200", "GB300", "V100", "P100", "P40"};
constexpr std::array kWith = {"RTX", "T4", "A2", "A10", "A10G", "A16", "A40", "L4", "L40", "L40S"};

template <typename List>
bool contains(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

std::string rayTracingCores(VkPhysicalDeviceType type, std::uint32_t vendorID, std::string_view name) {
  if (type == VK_PHYSICAL_DEVICE_TYPE_CPU) return "no";
  if (vendorID != kNvidia) return "unknown";
  std::string words(name);
  std::replace(words.begin(), words.end(), '-', ' ');
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    if (contains(kWithout, word)) return "no";
    if (contains(kWith, word)) return "yes";
  }
  return "unknown";
}

}  // namespace malus::vulkan
