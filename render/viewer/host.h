// Functions of the program that the viewer's module calls: the renderers are in the program and not a second time in
// the module. Program and module are built together, by one compiler; exceptions pass between them.
#pragma once

#include <memory>

#include "render/ground_truth/ground_truth.h"
#include "render/job.h"
#include "render/make_renderer.h"

namespace malus::viewer {

class Host {
 public:
  virtual ~Host() = default;
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  // As the functions of the same names in render/make_renderer.h and render/job.h.
  virtual std::unique_ptr<render::Renderer> makeRenderer(render::Backend backend, const pack::Scene& scene,
                                                         const render::RendererOptions& options) const = 0;
  virtual render::RenderParameters renderParameters(const render::JobSettings& settings,
                                                    const pack::Scene& scene) const = 0;
  virtual render::ImageChoice chooseImage(const render::JobSettings& settings,
                                          const render::RenderParameters& parameters,
                                          const pack::Scene& scene) const = 0;
  // The geometry that one pixel sees (render/ground_truth/ground_truth.h): parameters.region is the pixel. The first
  // call for a scene builds an acceleration structure, which is kept for later calls with the same object. Not
  // thread-safe.
  virtual render::PixelTruth pixelTruth(const pack::Scene& scene, const render::RenderParameters& parameters) const = 0;
  // Whether Ctrl-C was pressed (meshprep/base/interrupt.h), whose state is the program's.
  virtual bool interrupted() const = 0;

 protected:
  Host() = default;
};

}  // namespace malus::viewer
