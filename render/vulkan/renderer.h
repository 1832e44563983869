// The Vulkan renderer: ray-tracing pipelines and ray queries, on a GPU or, with lavapipe, on the CPU. Recursive methods
// recurse where the device allows it and use a stack elsewhere (tracing_choice.h).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "render/renderer.h"

namespace malus::vulkan {

struct Options {
  std::string device;         // number or part of a name (choosePhysicalDevice()); empty: the best
  unsigned threads = 0;       // of lavapipe; 0: chosen by the number of cores
  bool sharesPixels = false;  // as render::RendererOptions::sharesPixels
};

class Renderer final : public render::Renderer {
 public:
  // Uploads the scene, which must outlive the renderer, and builds its acceleration structures. Throws Error: no usable
  // device, out of memory, a scene too large for the device.
  Renderer(const pack::Scene& scene, const Options& options);
  Renderer(pack::Scene&& scene, const Options& options) = delete;
  ~Renderer() override;

  void prepare(const std::vector<render::Preparation>& images) override;
  // Compiles a method at its first use, unless it was prepared. Cost::traceMs is measured by the device's clock where
  // it has one. Throws Error also if the validation layers report a message. After an Error the renderer can be used
  // again.
  bool updateScene() override;
  render::RenderResult render(std::string_view method, const render::RenderParameters& parameters) override;
  bool acceptTarget(const std::shared_ptr<const render::SharedPixels>& target) override;
  render::RenderResult renderTo(std::string_view method, const render::RenderParameters& parameters,
                                const render::SharedPixels& target, std::size_t first) override;
  void releaseTargets() override;
  // By a variant of the shaders that counts; not timed.
  std::uint64_t countRays(std::string_view method, const render::RenderParameters& parameters) override;

  render::Backend backend() const override { return render::Backend::vulkan; }
  std::string device() const override;
  std::vector<std::string> methods() const override;
  std::vector<render::VulkanPath> vulkanPaths() const override;

 private:
  struct Impl;
  struct Target;
  render::RenderResult render(std::string_view method, const render::RenderParameters& parameters,
                              const Target& target);
  std::unique_ptr<Impl> impl_;
};

}  // namespace malus::vulkan
