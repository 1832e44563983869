#include "render/vulkan/pipeline.h"

#include <array>
#include <cstring>
#include <utility>

#include "render/vulkan/check.h"
#include "render/vulkan/shader_cache.h"

namespace malus::vulkan {

namespace {

VkShaderStageFlagBits flagOf(Stage stage) {
  switch (stage) {
    case Stage::raygen:
      return VK_SHADER_STAGE_RAYGEN_BIT_KHR;
    case Stage::miss:
      return VK_SHADER_STAGE_MISS_BIT_KHR;
    case Stage::closestHit:
      return VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR;
    case Stage::compute:
      return VK_SHADER_STAGE_COMPUTE_BIT;
  }
  return VK_SHADER_STAGE_COMPUTE_BIT;
}

// Modules live until the pipeline is made.
struct Modules {
  const Device& device;
  std::vector<VkShaderModule> list;
  ~Modules() {
    for (VkShaderModule m : list) vkDestroyShaderModule(device.get(), m, nullptr);
  }
};

VkDeviceSize alignedTo(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

}  // namespace

Pipeline::Pipeline(const Device& device, const Variant& variant, const render::RenderScene& scene,
                   VkDescriptorSetLayout bindings, std::uint32_t recursion)
    : Pipeline(device, variant, bindings, recursion, 0) {
  createTable(scene, stageSources(variant));
}

Pipeline::Pipeline(const Device& device, const Variant& variant, VkDescriptorSetLayout bindings,
                   std::uint32_t recursion, VkPipelineCreateFlags flags)
    : device_(device) {
  Modules modules{device, {}};
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  std::vector<VkRayTracingShaderGroupCreateInfoKHR> groups;
  for (const StageSource& source : stageSources(variant)) {
    const std::vector<std::uint32_t> spirv = cachedSpirv(variant, source);
    VkShaderModuleCreateInfo module{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module.codeSize = spirv.size() * sizeof(std::uint32_t);
    module.pCode = spirv.data();
    modules.list.push_back(VK_NULL_HANDLE);
    check(vkCreateShaderModule(device.get(), &module, nullptr, &modules.list.back()), "vkCreateShaderModule");
    VkPipelineShaderStageCreateInfo stage{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    stage.stage = flagOf(source.stage);
    stage.module = modules.list.back();
    stage.pName = "main";
    VkRayTracingShaderGroupCreateInfoKHR group{VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
    group.generalShader = group.closestHitShader = group.anyHitShader = group.intersectionShader = VK_SHADER_UNUSED_KHR;
    const auto index = static_cast<std::uint32_t>(stages.size());
    if (source.stage == Stage::closestHit) {
      group.type = VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
      group.closestHitShader = index;
    } else {
      group.type = VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
      group.generalShader = index;
    }
    stages.push_back(stage);
    groups.push_back(group);
  }

  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &bindings;
  check(vkCreatePipelineLayout(device.get(), &layout, nullptr, &layout_), "vkCreatePipelineLayout");
  VkRayTracingPipelineCreateInfoKHR info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
  info.flags = flags;
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.groupCount = static_cast<std::uint32_t>(groups.size());
  info.pGroups = groups.data();
  info.maxPipelineRayRecursionDepth = recursion;
  info.layout = layout_;
  try {
    check(device.createRayTracingPipelines(device.get(), VK_NULL_HANDLE, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
          "vkCreateRayTracingPipelinesKHR");
  } catch (...) {
    vkDestroyPipelineLayout(device.get(), layout_, nullptr);
    throw;
  }
}

Pipeline::~Pipeline() {
  if (pipeline_) vkDestroyPipeline(device_.get(), pipeline_, nullptr);
  if (layout_) vkDestroyPipelineLayout(device_.get(), layout_, nullptr);
}

void Pipeline::createTable(const render::RenderScene& scene, const std::vector<StageSource>& groups) {
  const auto groupCount = static_cast<std::uint32_t>(groups.size());
  const auto& limits = device_.rayTracing();
  const std::size_t handleBytes = limits.shaderGroupHandleSize;
  std::vector<std::byte> handles(handleBytes * groupCount);
  check(
      device_.getRayTracingShaderGroupHandles(device_.get(), pipeline_, 0, groupCount, handles.size(), handles.data()),
      "vkGetRayTracingShaderGroupHandlesKHR");

  // Ray generation, the misses, one hit record a mesh.
  std::uint32_t misses = 0;
  std::array<std::uint32_t, gpu::kSurfaceKinds> groupOf{};
  for (std::uint32_t i = 0; i < groupCount; ++i) {
    if (groups[i].stage == Stage::miss) ++misses;
    if (groups[i].stage == Stage::closestHit) groupOf[groups[i].kind] = i;
  }
  const VkDeviceSize stride = alignedTo(handleBytes, limits.shaderGroupHandleAlignment),
                     base = limits.shaderGroupBaseAlignment;
  const VkDeviceSize missAt = alignedTo(stride, base), hitAt = missAt + alignedTo(misses * stride, base);
  const bool raygenAlone = groupCount == 1;
  std::vector<std::byte> records(raygenAlone ? stride : hitAt + stride * scene.meshes.size());
  const auto put = [&](VkDeviceSize at, std::uint32_t group) {
    std::memcpy(records.data() + at, handles.data() + group * handleBytes, handleBytes);
  };
  put(0, 0);
  for (std::uint32_t i = 0; i < misses; ++i) put(missAt + stride * i, 1 + i);
  for (std::size_t i = 0; i < scene.meshes.size() && !raygenAlone; ++i)
    put(hitAt + stride * i, groupOf[scene.materials[scene.meshes[i].material].kind]);

  // The table's start must be aligned; a little room makes it so on every driver.
  std::vector<std::byte> padded(records.size() + base);
  Buffer probe(device_, padded.size(),
               VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                   VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  const VkDeviceAddress start = alignedTo(probe.address(), base);
  std::memcpy(padded.data() + (start - probe.address()), records.data(), records.size());
  Buffer staging(device_, padded.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                 VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  staging.write(padded);
  device_.submit([&](VkCommandBuffer commands) {
    const VkBufferCopy copy{0, 0, padded.size()};
    vkCmdCopyBuffer(commands, staging.get(), probe.get(), 1, &copy);
  });
  table_ = std::move(probe);
  raygen_ = {start, stride, stride};
  if (raygenAlone) return;
  miss_ = {start + missAt, stride, misses * stride};
  hit_ = {start + hitAt, stride, stride * scene.meshes.size()};
}

void Pipeline::trace(VkCommandBuffer commands, std::uint32_t width, std::uint32_t height) const {
  device_.cmdTraceRays(commands, &raygen_, &miss_, &hit_, &callable_, width, height, 1);
}

}  // namespace malus::vulkan
