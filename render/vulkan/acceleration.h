// The acceleration structures of a scene: a bottom level per origin of meshes, compacted, with one geometry per mesh,
// and one instance of each. They are built for fast traces.
#pragma once

#include <vector>

#include "render/scene/render_scene.h"
#include "render/vulkan/buffer.h"

namespace malus::vulkan {

class Acceleration {
 public:
  // device: must outlive the structures. positions, triangles: the scene's arrays on the device, with
  // VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR. Throws Error.
  Acceleration(const Device& device, const render::RenderScene& scene, const Buffer& positions,
               const Buffer& triangles);

  VkAccelerationStructureKHR top() const { return top_.structure.get(); }
  VkDeviceSize bottomBytes() const;

 private:
  struct Level {
    Buffer storage;
    Owned<VkAccelerationStructureKHR> structure;  // destroyed before its storage
  };
  // geometries: with ranges[i] primitives in geometries[i].
  static Level build(const Device& device, VkAccelerationStructureTypeKHR type,
                     const std::vector<VkAccelerationStructureGeometryKHR>& geometries,
                     const std::vector<VkAccelerationStructureBuildRangeInfoKHR>& ranges);
  static Level makeLevel(const Device& device, VkAccelerationStructureTypeKHR type, VkDeviceSize bytes);
  // The level in a buffer without unused memory.
  static Level compact(const Device& device, Level level);
  static Level buildBottom(const Device& device, const render::RenderScene& scene, const render::MeshRun& run,
                           const Buffer& positions, const Buffer& triangles);
  static std::vector<Level> buildBottoms(const Device& device, const render::RenderScene& scene,
                                         const Buffer& positions, const Buffer& triangles);
  static Level buildTop(const Device& device, const render::RenderScene& scene, const std::vector<Level>& bottoms);

  std::vector<Level> bottoms_;  // one per run of meshes
  Level top_;
};

}  // namespace malus::vulkan
