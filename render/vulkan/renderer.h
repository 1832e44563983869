// The Vulkan renderer: a ray-tracing pipeline with true recursion, on a GPU or on lavapipe.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "render/renderer.h"

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

class Renderer final : public render::Renderer {
 public:
  // Builds the acceleration structure and uploads the scene, which must outlive the renderer. Throws Error:
  // no device, one without ray tracing, out of memory.
  Renderer(const pack::Scene& scene, const Options& options);
  Renderer(pack::Scene&& scene, const Options& options) = delete;
  ~Renderer() override;

  // method: one of shaders/methods or shaders/iterative. Pipelines are made at the first use of a method and kept.
  // traceMs is the device's own time of the trace alone. Throws Error: a depth past the device's recursion limit, a
  // message of the validation layers.
  render::RenderResult render(std::string_view method, const render::RenderParameters& parameters) override;

  // Rays of a picture, from a variant that counts; not timed.
  std::uint64_t countRays(std::string_view method, const render::RenderParameters& parameters) override;

  render::Backend backend() const override { return render::Backend::vulkan; }
  std::string device() const override;
  // Iterative methods need ray queries.
  std::vector<std::string> methods() const override;
  // Recursive methods are limited by the device's recursion depth, iterative ones are not.
  std::uint32_t maxDepth(std::string_view method) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace malus::vulkan
