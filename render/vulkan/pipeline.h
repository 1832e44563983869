// A ray-tracing pipeline of one variant and its shader binding table.
#pragma once

#include "render/scene/render_scene.h"
#include "render/vulkan/buffer.h"
#include "render/vulkan/variant.h"

namespace malus::vulkan {

class Pipeline {
 public:
  // recursion: deepest nesting of traces, shadow rays included. The table has one hit record a mesh: the
  // group of its material's kind. Throws Error.
  Pipeline(const Device& device, const Variant& variant, const render::RenderScene& scene,
           VkDescriptorSetLayout bindings, std::uint32_t recursion);
  // Without a table: it is compiled and cannot trace. Its groups are those of stageSources(), in order.
  Pipeline(const Device& device, const Variant& variant, VkDescriptorSetLayout bindings, std::uint32_t recursion,
           VkPipelineCreateFlags flags);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  VkPipelineLayout layout() const { return layout_; }
  void trace(VkCommandBuffer commands, std::uint32_t width, std::uint32_t height) const;
  VkPipeline get() const { return pipeline_; }

 private:
  void createTable(const render::RenderScene& scene, const std::vector<StageSource>& groups);

  const Device& device_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  Buffer table_;
  VkStridedDeviceAddressRegionKHR raygen_{}, miss_{}, hit_{}, callable_{};
};

}  // namespace malus::vulkan
