// The renderers of one scene, each made when it is first needed.
#pragma once

#include <map>
#include <memory>

#include "render/make_renderer.h"

namespace malus::render {

// scene must outlive the set.
class RendererSet {
 public:
  RendererSet(const pack::Scene& scene, RendererOptions options) : scene_(scene), options_(std::move(options)) {}
  RendererSet(pack::Scene&& scene, RendererOptions options) = delete;

  // Throws as makeRenderer() does.
  Renderer& operator[](Backend backend) {
    std::unique_ptr<Renderer>& renderer = renderers_[backend];
    if (!renderer) renderer = makeRenderer(backend, scene_, options_);
    return *renderer;
  }

 private:
  const pack::Scene& scene_;
  RendererOptions options_;
  std::map<Backend, std::unique_ptr<Renderer>> renderers_;
};

}  // namespace malus::render
