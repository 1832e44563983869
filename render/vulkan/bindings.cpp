#include "render/vulkan/bindings.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

namespace {

struct Row {
  std::uint32_t number;
  std::string_view name;
  VkDescriptorType type;
};

constexpr std::array kRows = {
#define MALUS_ACCELERATION_STRUCTURE(number, name) Row{number, #name, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR},
#define MALUS_PIXEL_BUFFER(number, name, element) Row{number, #name, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
#define MALUS_SCENE_BUFFER(number, name, element, usage) Row{number, #name, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
#define MALUS_HOST_BUFFER(number, name, type, access) Row{number, #name, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
#include "shaders/gpu/bindings.def"
};

constexpr bool isNumberedInOrder() {
  for (std::uint32_t i = 0; i < kRows.size(); ++i)
    if (kRows[i].number != i) return false;
  return true;
}
static_assert(isNumberedInOrder(), "the rows of shaders/gpu/bindings.def must be numbered 0, 1, 2, ...");

VkWriteDescriptorSet makeWrite(VkDescriptorSet set, Binding binding) {
  const auto number = static_cast<std::uint32_t>(binding);
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstSet = set;
  write.dstBinding = number;
  write.descriptorCount = 1;
  write.descriptorType = kRows[number].type;
  return write;
}

}  // namespace

Owned<VkDescriptorSetLayout> createBindingsLayout(const Device& device) {
  std::array<VkDescriptorSetLayoutBinding, kRows.size()> list{};
  for (const Row& row : kRows)
    list[row.number] = {row.number, row.type, 1,
                        VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR |
                            VK_SHADER_STAGE_ANY_HIT_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR,
                        nullptr};
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = static_cast<std::uint32_t>(list.size());
  info.pBindings = list.data();
  return create(device.get(), vkCreateDescriptorSetLayout, info, vkDestroyDescriptorSetLayout,
                "vkCreateDescriptorSetLayout");
}

void requireBindable(const Device& device, std::string_view name, VkDeviceSize bytes) {
  const std::uint64_t limit = device.capabilities().maxStorageBufferRange;
  if (bytes > limit)
    throw Error(fmt::format("Vulkan device '{}'", device.physical().name),
                fmt::format("cannot bind the buffer '{}'", name),
                fmt::format("at most {} bytes (maxStorageBufferRange); reduce the scene's meshes or textures, or use "
                            "another device (--device) or --backend embree",
                            limit),
                fmt::format("{} bytes", bytes));
}

Bindings::Bindings(const Device& device) : device_(device), layout_(createBindingsLayout(device)) {
  std::array<VkDescriptorPoolSize, 2> sizes{{{VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 0},  //
                                             {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 0}}};
  for (const Row& row : kRows)
    for (VkDescriptorPoolSize& size : sizes)
      if (size.type == row.type) ++size.descriptorCount;
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.maxSets = 1;
  pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  pool.pPoolSizes = sizes.data();
  pool_ = create(device.get(), vkCreateDescriptorPool, pool, vkDestroyDescriptorPool, "vkCreateDescriptorPool");

  const VkDescriptorSetLayout layout = layout_.get();
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = pool_.get();
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &layout;
  check(vkAllocateDescriptorSets(device.get(), &allocate, &set_), "vkAllocateDescriptorSets");
}

void Bindings::bind(Binding binding, const Buffer& buffer) {
  requireBindable(device_, kRows[static_cast<std::uint32_t>(binding)].name, buffer.sizeBytes());
  const VkDescriptorBufferInfo info{buffer.get(), 0, VK_WHOLE_SIZE};
  VkWriteDescriptorSet write = makeWrite(set_, binding);
  write.pBufferInfo = &info;
  vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);
}

void Bindings::bind(Binding binding, VkAccelerationStructureKHR structure) {
  VkWriteDescriptorSetAccelerationStructureKHR info{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
  info.accelerationStructureCount = 1;
  info.pAccelerationStructures = &structure;
  VkWriteDescriptorSet write = makeWrite(set_, binding);
  write.pNext = &info;
  vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);
}

}  // namespace malus::vulkan
