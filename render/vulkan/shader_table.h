// The shader binding table of a pipeline: the records that a trace selects shaders by.
#pragma once

#include <vector>

#include "render/scene/render_scene.h"
#include "render/vulkan/buffer.h"
#include "render/vulkan/variant.h"

namespace malus::vulkan {

class ShaderTable {
 public:
  // device: must outlive the table. groups: the shader groups of the pipeline, in order. The table has one hit record
  // per mesh, the group of its material's kind of surface, or a single one if one group serves every kind. Throws
  // Error.
  ShaderTable(const Device& device, VkPipeline pipeline, const std::vector<StageSource>& groups,
              const render::RenderScene& scene);

  void trace(VkCommandBuffer commands, std::uint32_t width, std::uint32_t height) const;

 private:
  const Device* device_;
  Buffer records_;
  VkStridedDeviceAddressRegionKHR raygen_{}, miss_{}, hit_{}, callable_{};
};

}  // namespace malus::vulkan
