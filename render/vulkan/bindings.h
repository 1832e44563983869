// What every stage sees of the scene, as shaders/stages/bindings.glsl numbers it.
#pragma once

#include <cstdint>

#include "render/vulkan/device.h"

namespace malus::vulkan {

enum Binding : std::uint32_t {
  kTlas,
  kPixels,
  kFrame,
  kMaterials,
  kLights,
  kMeshes,
  kTriangles,
  kPositions,
  kNormals,
  kTexels,
  kCounter,
  kFaults,
  kExtras,
  kTextures,
  kTextureTexels,
  kBindings
};

VkDescriptorType typeOf(Binding binding);

// The caller destroys it. Throws Error.
VkDescriptorSetLayout createBindingsLayout(const Device& device);

}  // namespace malus::vulkan
