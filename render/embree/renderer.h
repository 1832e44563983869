// The Embree renderer: single precision, packets or one ray at a time, tiles in parallel on TBB threads.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "render/embree/embree.h"
#include "render/embree/ray_log.h"
#include "render/renderer.h"

namespace malus::embree {

class Renderer final : public render::Renderer {
 public:
  // Builds the acceleration structure. scene must outlive the renderer. threads: 0 for all cores. Throws Error if
  // Embree fails.
  Renderer(const pack::Scene& scene, unsigned threads);
  Renderer(pack::Scene&& scene, unsigned threads) = delete;
  ~Renderer() override;

  render::Backend backend() const override { return render::Backend::embree; }
  std::string device() const override;
  int threads() const;
  std::vector<std::string> methods() const override;
  std::vector<render::EmbreePath> embreePaths() const override;
  bool updateScene() override;
  render::RenderResult render(std::string_view method, const render::RenderParameters& parameters) override;

  // The rays that render() traces with the same arguments, tile by tile. Memory: 24 bytes per ray, twice.
  RayLog logRays(std::string_view method, const render::RenderParameters& parameters);
  // The acceleration structure, valid as long as the renderer.
  const Bvh& bvh() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace malus::embree
