// The acceleration structures of a scene: a bottom level per origin of meshes, compacted, with one geometry per mesh,
// and one instance of each; and a bottom level per mesh that is placed several times, with an instance per place. They
// are built for fast traces.
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
  std::size_t bottoms() const { return bottoms_.size(); }
  std::size_t instances() const { return instances_; }

 private:
  struct Level {
    Buffer storage;
    Owned<VkAccelerationStructureKHR> structure;  // destroyed before its storage
  };
  struct Build;
  struct Built {
    std::vector<Level> levels;
    Owned<VkQueryPool> sizes;  // compacted size of each bottom level
  };
  static Level makeLevel(const Device& device, VkAccelerationStructureTypeKHR type, VkDeviceSize bytes);
  // Builds structures of one type by one submission. Takes their levels.
  static Built buildAll(const Device& device, std::vector<Build>& builds);
  // The levels in buffers without unused memory, copied by one submission.
  static std::vector<Level> compact(const Device& device, Built built);
  static std::vector<Level> buildBottoms(const Device& device, const render::RenderScene& scene,
                                         const Buffer& positions, const Buffer& triangles);
  static Level buildTop(const Device& device, const render::RenderScene& scene, const std::vector<Level>& bottoms);

  std::vector<Level> bottoms_;  // one per shape of the runs of meshes
  Level top_;
  std::size_t instances_ = 0;
};

}  // namespace malus::vulkan
