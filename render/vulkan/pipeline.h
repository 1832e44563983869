// A ray-tracing pipeline of one variant.
#pragma once

#include <cstdint>

#include "render/vulkan/device.h"
#include "render/vulkan/variant.h"

namespace malus::vulkan {

// Nested traces for a depth (most specular interactions): recursion adds the camera ray and a shadow ray from the last
// hit; otherwise only the ray generation shader traces.
std::uint32_t requiredRecursion(Tracing tracing, std::uint32_t depth);

VkShaderStageFlagBits shaderStage(Stage stage);

class Pipeline {
 public:
  // device, bindings: must outlive the pipeline. recursion: deepest nesting of traces, shadow rays included. Its shader
  // groups are those of stageSources(), in order. Pipelines can be made by several threads at once. Throws Error.
  Pipeline(const Device& device, const Variant& variant, VkDescriptorSetLayout bindings, std::uint32_t recursion,
           VkPipelineCreateFlags flags = 0);

  VkPipeline get() const { return pipeline_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }

 private:
  Owned<VkPipelineLayout> layout_;
  Owned<VkPipeline> pipeline_;
};

}  // namespace malus::vulkan
