// Turns a failed Vulkan call into an Error that names it.
#pragma once

#include <string>
#include <string_view>

#include <vulkan/vulkan.h>

namespace malus::vulkan {

void check(VkResult result, std::string_view call);  // throws Error unless VK_SUCCESS
std::string nameOf(VkResult result);

}  // namespace malus::vulkan
