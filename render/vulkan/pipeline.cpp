#include "render/vulkan/pipeline.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "render/vulkan/pipeline_cache.h"
#include "render/vulkan/shader_cache.h"

namespace malus::vulkan {

namespace {

// Shader modules, stages and groups of a pipeline. The modules are needed until the pipeline exists.
struct Shaders {
  std::vector<Owned<VkShaderModule>> modules;
  std::string code;  // SPIR-V of all stages
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  std::vector<VkRayTracingShaderGroupCreateInfoKHR> groups;
};

Owned<VkShaderModule> createModule(const Device& device, const std::vector<std::uint32_t>& spirv,
                                   const StageSource& source) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = spirv.size() * sizeof(std::uint32_t);
  info.pCode = spirv.data();
  return create(device.get(), vkCreateShaderModule, info, vkDestroyShaderModule,
                fmt::format("vkCreateShaderModule ({})", source.path));
}

Shaders createShaders(const Device& device, const Variant& variant) {
  Shaders result;
  for (const StageSource& source : stageSources(variant)) {
    const std::vector<std::uint32_t> spirv = cachedSpirv(variant, source);
    result.code.append(reinterpret_cast<const char*>(spirv.data()), spirv.size() * sizeof(std::uint32_t));
    result.modules.push_back(createModule(device, spirv, source));
    VkPipelineShaderStageCreateInfo stage{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    stage.stage = shaderStage(source.stage);
    stage.module = result.modules.back().get();
    stage.pName = "main";
    if (source.stage == Stage::anyHit) {
      for (VkRayTracingShaderGroupCreateInfoKHR& group : result.groups)
        if (group.closestHitShader != VK_SHADER_UNUSED_KHR)
          group.anyHitShader = static_cast<std::uint32_t>(result.stages.size());
      result.stages.push_back(stage);
      continue;
    }
    VkRayTracingShaderGroupCreateInfoKHR group{VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
    group.generalShader = group.closestHitShader = group.anyHitShader = group.intersectionShader = VK_SHADER_UNUSED_KHR;
    const bool isHit = source.stage == Stage::closestHit;
    group.type =
        isHit ? VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR : VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
    (isHit ? group.closestHitShader : group.generalShader) = static_cast<std::uint32_t>(result.stages.size());
    result.stages.push_back(stage);
    result.groups.push_back(group);
  }
  return result;
}

}  // namespace

std::uint32_t requiredRecursion(Tracing tracing, std::uint32_t depth) {
  return tracing == Tracing::recursion ? depth + 2 : 1;
}

VkShaderStageFlagBits shaderStage(Stage stage) {
  switch (stage) {
    case Stage::raygen:
      return VK_SHADER_STAGE_RAYGEN_BIT_KHR;
    case Stage::miss:
      return VK_SHADER_STAGE_MISS_BIT_KHR;
    case Stage::closestHit:
      return VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR;
    case Stage::anyHit:
      return VK_SHADER_STAGE_ANY_HIT_BIT_KHR;
    case Stage::compute:
      return VK_SHADER_STAGE_COMPUTE_BIT;
  }
  return VK_SHADER_STAGE_COMPUTE_BIT;
}

Pipeline::Pipeline(const Device& device, const Variant& variant, VkDescriptorSetLayout bindings,
                   std::uint32_t recursion, VkPipelineCreateFlags flags) {
  const Shaders shaders = createShaders(device, variant);
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &bindings;
  layout_ = create(device.get(), vkCreatePipelineLayout, layout, vkDestroyPipelineLayout, "vkCreatePipelineLayout");

  VkRayTracingPipelineCreateInfoKHR info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
  info.flags = flags;
  info.stageCount = static_cast<std::uint32_t>(shaders.stages.size());
  info.pStages = shaders.stages.data();
  info.groupCount = static_cast<std::uint32_t>(shaders.groups.size());
  info.pGroups = shaders.groups.data();
  info.maxPipelineRayRecursionDepth = recursion;
  info.layout = layout_.get();
  const PipelineCache cache(device, fmt::format("{} {} ", recursion, flags) + shaders.code);
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result = device.functions().createRayTracingPipelines(device.get(), VK_NULL_HANDLE, cache.get(), 1,
                                                                       &info, nullptr, &pipeline);
  pipeline_ = {device.get(), pipeline, vkDestroyPipeline};
  check(result, fmt::format("vkCreateRayTracingPipelinesKHR (method {})", variant.method));
  cache.save();
}

}  // namespace malus::vulkan
