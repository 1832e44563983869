// The Embree renderer: float, one ray at a time, tiles on TBB threads.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/picture.h"
#include "render/scene/render_scene.h"

namespace malus::embree {

class Renderer {
 public:
  // threads: 0 for all cores. Throws Error.
  Renderer(const pack::Scene& scene, unsigned threads);
  ~Renderer();

  // method: one of render::methods(). Throws Error for another.
  render::Picture render(std::string_view method, const render::RenderParameters& parameters) const;

  std::string device() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace malus::embree
