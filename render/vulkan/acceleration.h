// The acceleration structures of a scene: one bottom level with a geometry per mesh, one instance.
#pragma once

#include "render/scene/render_scene.h"
#include "render/vulkan/buffer.h"

namespace malus::vulkan {

class Acceleration {
 public:
  // positions, triangles: the scene's arrays on the device, usable as build input. Throws Error.
  Acceleration(const Device& device, const render::RenderScene& scene, const Buffer& positions,
               const Buffer& triangles);
  ~Acceleration();
  Acceleration(const Acceleration&) = delete;
  Acceleration& operator=(const Acceleration&) = delete;

  VkAccelerationStructureKHR top() const { return top_; }

 private:
  VkAccelerationStructureKHR build(VkAccelerationStructureBuildGeometryInfoKHR& info,
                                   const std::vector<VkAccelerationStructureBuildRangeInfoKHR>& ranges,
                                   Buffer& storage);

  const Device& device_;
  Buffer bottomStorage_, topStorage_;
  VkAccelerationStructureKHR bottom_ = VK_NULL_HANDLE, top_ = VK_NULL_HANDLE;
};

}  // namespace malus::vulkan
