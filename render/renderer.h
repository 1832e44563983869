// The interface of every renderer. render/make_renderer.h makes one for a backend.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/backend.h"
#include "render/scene/render_parameters.h"
#include "render/scene/render_result.h"
#include "render/shared_pixels.h"

namespace malus::render {

// An image that will be rendered.
struct Preparation {
  std::string method;
  RenderParameters parameters;
  bool countRays = false;  // by countRays() too
};

// A renderer refers to the pack::Scene that it was made from: the scene must outlive the renderer. Its camera may
// change between two calls; materials, lights, environment and wavelengths may change before a call of updateScene();
// nothing else may change. Calls must not overlap; a renderer uses several threads by itself.
class Renderer {
 public:
  virtual ~Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  virtual Backend backend() const = 0;
  // The device and its driver, for reports: "Embree 3.13.5, 8 threads".
  virtual std::string device() const = 0;

  // Names of the methods that the device can render by; empty if the backend has no methods.
  virtual std::vector<std::string> methods() const = 0;
  // Paths of a device of the Vulkan renderer, the one that iterative methods take automatically first; else empty.
  virtual std::vector<VulkanPath> vulkanPaths() const { return {}; }
  // Paths of the Embree renderer on this processor, the automatic one first; else empty.
  virtual std::vector<EmbreePath> embreePaths() const { return {}; }

  // Prepares images, so that their first render() is faster: Vulkan compiles their shaders in parallel. Optional; what
  // fails is reported by render().
  virtual void prepare(const std::vector<Preparation>& /*images*/) {}

  // Takes over changed materials, lights, environment and wavelengths of the scene, and keeps the acceleration
  // structure and the pipelines. Returns false if the change needs a new renderer; this one must then not be used any
  // more. Throws Error: out of memory.
  virtual bool updateScene() = 0;

  // report: called with the fraction of the image that is finished, at most once per second, by renderers that render
  // in parts.
  void setProgress(std::function<void(double)> report) { progress_ = std::move(report); }

  // Renders parameters.region. method: one of methods(), ignored by a backend without methods. Throws Error: an unknown
  // method, a path that the device does not have. Throws Interrupted (meshprep/base/interrupt.h) within an
  // InterruptScope, between the parts of an image.
  virtual RenderResult render(std::string_view method, const RenderParameters& parameters) = 0;
  // Whether renderTo() can write this memory: it is of the renderer's device. Only renderers that were made for it
  // (RendererOptions::sharesPixels) have such memory.
  virtual bool acceptTarget(const std::shared_ptr<const SharedPixels>& /*target*/) { return false; }
  // Renders as render(), but leaves the pixels of the region in an accepted target, from its value number `first` on.
  // The result has no pixels: none are copied to the host. Throws as render() does.
  virtual RenderResult renderTo(std::string_view method, const RenderParameters& parameters, const SharedPixels& target,
                                std::size_t first);
  // Forgets the accepted targets, so that their memory can be freed.
  virtual void releaseTargets() {}
  // Renders once more, untimed, to count camera, specular and shadow rays. Needed only if render() left Cost::rays
  // at 0. Throws as render() does.
  virtual std::uint64_t countRays(std::string_view method, const RenderParameters& parameters) {
    return render(method, parameters).cost.rays;
  }

 protected:
  Renderer() = default;
  const std::function<void(double)>& progress() const { return progress_; }

 private:
  std::function<void(double)> progress_;
};

}  // namespace malus::render
