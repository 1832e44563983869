// Traces recorded rays again, and nothing else: the floor of the Vulkan renderer (`malus bench rays`).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"
#include "render/scene/vulkan_path.h"
#include "render/vulkan/renderer.h"

namespace malus::vulkan {

// As in shaders/stages/replay.rgen. Coordinates as in gpu::CameraParameters. A shadow ray ends at d times 1.
struct RecordedRay {
  glm::vec3 origin;
  glm::vec3 d;
};
static_assert(sizeof(RecordedRay) == 24);

struct ReplayTime {
  double ms = 0;           // by the device's clock where it has one; without transfers
  std::uint64_t hits = 0;  // rays that meet a triangle; of shadow rays: those that are blocked
};

class RayReplay {
 public:
  // Builds the same acceleration structures as the renderer, on a separate VkDevice. scene is not needed
  // afterwards. Throws Error as the renderer does.
  RayReplay(const pack::Scene& scene, const Options& options);
  ~RayReplay();

  // As Renderer::vulkanPaths().
  std::vector<render::VulkanPath> paths() const;

  // Traces the rays in their order, in launches of at most kReplayRays. The first call for a path and kind of rays
  // compiles its shaders and traces one ray before the timed launches. path: one of paths(). Throws Error.
  ReplayTime replay(render::VulkanPath path, bool shadow, std::span<const RecordedRay> rays);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Rays per launch: 24 MiB of rays.
inline constexpr std::size_t kReplayRays = std::size_t{1} << 20;

}  // namespace malus::vulkan
