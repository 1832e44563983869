// A compute shader with one storage buffer, for checks of the validation layers.
#pragma once

#include <cstdint>
#include <vector>

#include "render/vulkan/buffer.h"
#include "render/vulkan/glsl_compiler.h"

namespace malus::test {

class ComputeProgram {
 public:
  // device: must outlive the program. glsl: of a shader with one storage buffer, at set 0, binding 0.
  ComputeProgram(const vulkan::Device& device, const char* glsl, const vulkan::Buffer& buffer) : device_(device) {
    using vulkan::create;
    const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT,
                                               nullptr};
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = 1;
    setInfo.pBindings = &binding;
    setLayout_ = create(device.get(), vkCreateDescriptorSetLayout, setInfo, vkDestroyDescriptorSetLayout, "set layout");
    const VkDescriptorSetLayout setLayout = setLayout_.get();
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout;
    layout_ = create(device.get(), vkCreatePipelineLayout, layoutInfo, vkDestroyPipelineLayout, "layout");
    makePipeline(glsl);
    makeSet(setLayout, buffer);
  }

  void dispatch() const {
    device_.submit("compute", [&](VkCommandBuffer commands) {
      vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &set_, 0, nullptr);
      vkCmdDispatch(commands, 1, 1, 1);
    });
  }

 private:
  void makePipeline(const char* glsl) {
    const std::vector<std::uint32_t> code = vulkan::compileGlsl(glsl, "", vulkan::Stage::compute, "test",
                                                                [](std::string_view) { return std::string_view(); });
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = code.size() * sizeof(std::uint32_t);
    moduleInfo.pCode = code.data();
    const auto shader =
        vulkan::create(device_.get(), vkCreateShaderModule, moduleInfo, vkDestroyShaderModule, "shader");
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader.get();
    info.stage.pName = "main";
    info.layout = layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    vulkan::check(vkCreateComputePipelines(device_.get(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "pipeline");
    pipeline_ = {device_.get(), pipeline, vkDestroyPipeline};
  }

  void makeSet(VkDescriptorSetLayout setLayout, const vulkan::Buffer& buffer) {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = poolInfo.poolSizeCount = 1;
    poolInfo.pPoolSizes = &size;
    pool_ = vulkan::create(device_.get(), vkCreateDescriptorPool, poolInfo, vkDestroyDescriptorPool, "pool");
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = pool_.get();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout;
    vulkan::check(vkAllocateDescriptorSets(device_.get(), &allocate, &set_), "set");
    const VkDescriptorBufferInfo bufferInfo{buffer.get(), 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &bufferInfo;
    vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);
  }

  const vulkan::Device& device_;
  vulkan::Owned<VkDescriptorSetLayout> setLayout_;
  vulkan::Owned<VkPipelineLayout> layout_;
  vulkan::Owned<VkPipeline> pipeline_;
  vulkan::Owned<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace malus::test
