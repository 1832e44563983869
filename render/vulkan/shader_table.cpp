#include "render/vulkan/shader_table.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "render/vulkan/uploads.h"

namespace malus::vulkan {

namespace {

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

std::vector<std::byte> readHandles(const Device& device, VkPipeline pipeline, std::uint32_t groups) {
  std::vector<std::byte> handles(device.capabilities().shaderGroupHandleSize * groups);
  check(device.functions().getRayTracingShaderGroupHandles(device.get(), pipeline, 0, groups, handles.size(),
                                                           handles.data()),
        "vkGetRayTracingShaderGroupHandlesKHR");
  return handles;
}

}  // namespace

ShaderTable::ShaderTable(const Device& device, VkPipeline pipeline, const std::vector<StageSource>& groups,
                         const render::RenderScene& scene)
    : device_(&device) {
  const Capabilities& limits = device.capabilities();
  const std::size_t handleBytes = limits.shaderGroupHandleSize;
  const VkDeviceSize stride = alignUp(handleBytes, limits.shaderGroupHandleAlignment),
                     base = limits.shaderGroupBaseAlignment;

  // The groups of each region: ray generation, the misses, the hits.
  std::vector<std::uint32_t> misses, hits;
  std::map<std::uint32_t, std::uint32_t> groupOfKind;
  const auto groupCount = static_cast<std::uint32_t>(std::count_if(
      groups.begin(), groups.end(), [](const StageSource& group) { return group.stage != Stage::anyHit; }));
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    if (groups[i].stage == Stage::miss) misses.push_back(i);
    if (groups[i].stage != Stage::closestHit) continue;
    if (groups[i].kind)
      groupOfKind[*groups[i].kind] = i;
    else
      hits.assign(scene.meshes.size(), i);  // an instance's records start at its first mesh
  }
  if (!groupOfKind.empty())
    for (const gpu::Mesh& mesh : scene.meshes) hits.push_back(groupOfKind.at(scene.materials[mesh.material].kind));

  // The regions, each aligned to `base`.
  const VkDeviceSize missAt = alignUp(stride, base), hitAt = missAt + alignUp(misses.size() * stride, base);
  std::vector<std::byte> records(hitAt + hits.size() * stride);
  const std::vector<std::byte> handles = readHandles(device, pipeline, groupCount);
  const auto put = [&](VkDeviceSize at, std::uint32_t group) {
    std::memcpy(records.data() + at, handles.data() + group * handleBytes, handleBytes);
  };
  put(0, 0);
  for (std::size_t i = 0; i < misses.size(); ++i) put(missAt + i * stride, misses[i]);
  for (std::size_t i = 0; i < hits.size(); ++i) put(hitAt + i * stride, hits[i]);

  // The start of the table must be aligned too, whatever the address of the buffer.
  records_ = Buffer(device, "shader binding table", records.size() + base,
                    VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                        VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                    kDeviceMemory);
  const VkDeviceAddress start = alignUp(records_.address(), base);
  records.insert(records.begin(), start - records_.address(), std::byte{0});
  copyToBuffer(device, "shader binding table", records, records_);
  raygen_ = {start, stride, stride};
  if (!misses.empty()) miss_ = {start + missAt, stride, misses.size() * stride};
  if (!hits.empty()) hit_ = {start + hitAt, stride, hits.size() * stride};
}

void ShaderTable::trace(VkCommandBuffer commands, std::uint32_t width, std::uint32_t height) const {
  device_->functions().cmdTraceRays(commands, &raygen_, &miss_, &hit_, &callable_, width, height, 1);
}

}  // namespace malus::vulkan
