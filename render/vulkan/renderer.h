// The Vulkan renderer: a ray-tracing pipeline with true recursion, on a GPU or on lavapipe.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/picture.h"
#include "render/scene/render_parameters.h"

namespace malus::vulkan {

struct Options {
  std::string device;    // number or part of a name; "" for the best
  unsigned threads = 0;  // of lavapipe; 0 for its best
};

struct DeviceDescription {
  std::string name;
  std::string driver;
  std::string problem;  // empty: it can be used
};
std::vector<DeviceDescription> devices();

class Renderer {
 public:
  // Builds the acceleration structure and uploads the scene, which must outlive the renderer. Throws Error:
  // no device, one without ray tracing, out of memory.
  Renderer(const pack::Scene& scene, const Options& options);
  ~Renderer();

  // method: one of shaders/methods or shaders/iterative. Pipelines are made at the first use of a method and kept.
  // traceMs is the device's own time of the trace alone. Throws Error: a depth past the device's recursion limit, a
  // message of the validation layers.
  render::Picture render(std::string_view method, const render::RenderParameters& parameters);

  // Rays of a picture, from a variant that counts; not timed.
  std::uint64_t countRays(std::string_view method, const render::RenderParameters& parameters);

  std::string device() const;
  // Most specular interactions that the device's recursion allows; methods that loop have no such limit.
  std::uint32_t maxDepth() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace malus::vulkan
