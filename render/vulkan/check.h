// Results of Vulkan calls as errors.
#pragma once

#include <string>
#include <string_view>

#include <vulkan/vulkan.h>

namespace malus::vulkan {

// Throws Error unless result is VK_SUCCESS. step: the call and, in brackets, its purpose, such as
// "vkAllocateMemory (normals, 48 bytes)".
void check(VkResult result, std::string_view step);

// "out of device memory"; "VkResult -1000" for values without a text.
std::string resultName(VkResult result);

}  // namespace malus::vulkan
