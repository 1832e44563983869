#include "render/vulkan/bindings.h"

#include <vector>

#include "render/vulkan/check.h"

namespace malus::vulkan {

VkDescriptorType typeOf(Binding binding) {
  return binding == kTlas ? VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

VkDescriptorSetLayout createBindingsLayout(const Device& device) {
  std::vector<VkDescriptorSetLayoutBinding> list;
  for (std::uint32_t i = 0; i < kBindings; ++i)
    list.push_back({i, typeOf(static_cast<Binding>(i)), 1,
                    VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR,
                    nullptr});
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = kBindings;
  info.pBindings = list.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device.get(), &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
  return layout;
}

}  // namespace malus::vulkan
