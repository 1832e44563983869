// The renderers of one scene, and of copies of it without effects, by backend.
#pragma once

#include <map>

#include "render/renderer_pool.h"

namespace malus::render {

// scene must outlive the set.
class RendererSet {
 public:
  RendererSet(const pack::Scene& scene, RendererOptions options) : scene_(scene), options_(std::move(options)) {}
  RendererSet(pack::Scene&& scene, RendererOptions options) = delete;

  // The renderer of the scene. Throws as makeRenderer() does.
  Renderer& operator[](Backend backend) { return pool(backend)[nullptr]; }

  RendererPool& pool(Backend backend) { return pools_.try_emplace(backend, scene_, backend, options_).first->second; }

 private:
  const pack::Scene& scene_;
  RendererOptions options_;
  std::map<Backend, RendererPool> pools_;
};

}  // namespace malus::render
