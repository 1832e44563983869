// The renderers of one backend for a scene and for copies of it without effects, each made when it is first needed.
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "render/make_renderer.h"

namespace malus::render {

class RendererPool {
 public:
  // whole must outlive the pool.
  RendererPool(const pack::Scene& whole, Backend backend, RendererOptions options)
      : whole_(whole), backend_(backend), options_(std::move(options)) {}
  RendererPool(pack::Scene&& whole, Backend backend, RendererOptions options) = delete;

  // Of a scene, which is kept; null: the whole one. Throws as makeRenderer() does.
  Renderer& operator[](const std::shared_ptr<const pack::Scene>& scene) {
    Entry& entry = entries_[scene.get()];
    if (!entry.renderer) {
      entry.scene = scene;
      entry.renderer = makeRenderer(backend_, scene ? *scene : whole_, options_);
    }
    return *entry.renderer;
  }

  // Destroys all renderers except one.
  void keepOnly(const std::shared_ptr<const pack::Scene>& scene) {
    std::erase_if(entries_, [&](const auto& entry) { return entry.first != scene.get(); });
  }

  Backend backend() const { return backend_; }

 private:
  struct Entry {
    std::shared_ptr<const pack::Scene> scene;  // destroyed after the renderer, which refers to it
    std::unique_ptr<Renderer> renderer;
  };
  const pack::Scene& whole_;
  Backend backend_;
  RendererOptions options_;
  std::map<const pack::Scene*, Entry> entries_;
};

}  // namespace malus::render
