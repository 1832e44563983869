// Makes the renderer of a backend, and runs the depth probe.
#pragma once

#include <memory>
#include <string>

#include "bake/depth_probe.h"
#include "bake/pack/scene.h"
#include "render/renderer.h"

namespace malus::render {

struct RendererOptions {
  std::string device;         // Vulkan: number or part of a name; "" for the best. Ignored by other backends
  unsigned threads = 0;       // CPU threads, lavapipe's included; 0 for all
  bool sharesPixels = false;  // can leave images on its device (Renderer::renderTo())
};

// Builds the acceleration structure and, on a GPU, uploads the scene. scene must outlive the renderer. Throws Error: no
// device, one without ray tracing, out of memory.
std::unique_ptr<Renderer> makeRenderer(Backend backend, const pack::Scene& scene, const RendererOptions& options);
std::unique_ptr<Renderer> makeRenderer(Backend backend, pack::Scene&& scene, const RendererOptions& options) = delete;

// The depth probe of the reference renderer.
bake::DepthProbe probeDepth(const pack::Scene& scene);

}  // namespace malus::render
