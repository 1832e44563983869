// The reference renderer: double precision, full Stokes vectors and 4 x 4 Mueller matrices per colour, hit points
// refined in double, recursion over batches of rays. Simple, so that its formulas can be checked by hand.
#pragma once

#include <memory>

#include "bake/depth_probe.h"
#include "bake/pack/scene.h"
#include "render/renderer.h"

namespace malus::reference {

// Images always have Stokes channels.
class Renderer final : public render::Renderer {
 public:
  // Builds the acceleration structure. scene must outlive the renderer. threads: 0 for all cores. Throws Error if
  // Embree fails.
  Renderer(const pack::Scene& scene, unsigned threads);
  Renderer(pack::Scene&& scene, unsigned threads) = delete;
  ~Renderer() override;

  render::Backend backend() const override { return render::Backend::reference; }
  std::string device() const override;
  std::vector<std::string> methods() const override { return {}; }
  bool updateScene() override;
  render::RenderResult render(std::string_view method, const render::RenderParameters& parameters) override;

  // Follows the paths of at most 32 x 32 pixels without a limit of the depth. Deterministic; at most 2^20 rays.
  bake::DepthProbe probeDepth();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Renders one image by a new renderer.
render::RenderResult render(const pack::Scene& scene, const render::RenderParameters& parameters, unsigned threads);

}  // namespace malus::reference
