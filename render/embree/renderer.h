// The Embree renderer: single precision, one ray at a time, tiles in parallel on TBB threads.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
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
  std::vector<std::string> methods() const override;
  render::RenderResult render(std::string_view method, const render::RenderParameters& parameters) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace malus::embree
