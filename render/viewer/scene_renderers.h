// The renderers of one scene, and of copies of it without effects. Each copy has a camera that can be set before a call
// of its renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/viewer/host.h"
#include "render/viewer/view_state.h"

namespace malus::viewer {

// An image of a side, ready to be rendered.
struct SideImage {
  render::Renderer* renderer = nullptr;
  pack::Scene* scene = nullptr;  // that the renderer refers to
  std::string method;            // after --effects
  render::RenderParameters parameters;
  std::string substitutedFor;
  std::vector<std::string> warnings;
};

class SceneRenderers {
 public:
  // scene is copied; the copies outlive the renderers. host must outlive the object.
  SceneRenderers(const Host& host, const pack::Scene& scene, render::RendererOptions options);
  ~SceneRenderers();

  const pack::Scene& scene() const { return *whole_; }
  // Chooses method and effects, and makes the renderer if there is none yet: of the renderers that were used least
  // recently, all but kMost are destroyed. The result is valid until the next but one call. Throws as
  // render::chooseImage() and makeRenderer() do.
  SideImage prepare(const render::JobSettings& settings);
  // Releases the shared images of all renderers but the two that were used last.
  void releaseUnused();

 private:
  static constexpr std::size_t kMost = 4;
  struct Entry;
  Entry& entry(render::Backend backend, const std::vector<std::string>& off);

  const Host& host_;
  render::RendererOptions options_;
  std::unique_ptr<pack::Scene> whole_;
  std::vector<std::unique_ptr<Entry>> entries_;  // used last first
};

}  // namespace malus::viewer
