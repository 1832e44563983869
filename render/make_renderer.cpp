#include "render/make_renderer.h"

#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/vulkan/renderer.h"

namespace malus::render {

std::unique_ptr<Renderer> makeRenderer(Backend backend, const pack::Scene& scene, const RendererOptions& options) {
  switch (backend) {
    case Backend::vulkan:
      return std::make_unique<vulkan::Renderer>(scene,
                                                vulkan::Options{options.device, options.threads, options.sharesPixels});
    case Backend::embree:
      return std::make_unique<embree::Renderer>(scene, options.threads);
    case Backend::reference:
      break;
  }
  return std::make_unique<reference::Renderer>(scene, options.threads);
}

bake::DepthProbe probeDepth(const pack::Scene& scene) { return reference::Renderer(scene, 0).probeDepth(); }

}  // namespace malus::render
