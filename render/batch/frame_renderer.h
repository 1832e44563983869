// Renders the frames of a batch with one renderer: a frame changes the camera, materials and lights below it, and the
// acceleration structure and the pipelines stay, unless Renderer::updateScene() needs a new one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "meshprep/base/image.h"
#include "render/batch/frame.h"
#include "render/ground_truth/ground_truth.h"
#include "render/renderer.h"

namespace malus::render {

// The contents of the files of a frame, or of a tile of it.
struct RenderedFrame {
  std::string method;     // that rendered, after --effects
  image::Image image;     // empty if no output needs it
  image::Image truth;     // empty unless asked for
  nlohmann::json camera;  // cameraJson()
  double traceMs = 0;     // of the image
};

class FrameRenderer {
 public:
  // threads, device: as of RendererOptions.
  FrameRenderer(pack::Pack pack, Backend backend, std::string device, unsigned threads);
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  // The pack's scene, before the changes of any frame.
  const pack::Scene& scene() const { return base_; }
  std::uint64_t packHash() const { return pack_.hash; }

  // Prints each warning once. part: the pixels of a tile alone; the attributes are those of the frame. Throws as
  // Renderer::render().
  RenderedFrame render(const Frame& frame) { return render(frame, frame.region); }
  RenderedFrame render(const Frame& frame, const Region& part);

  // Renderer::device() without the number of threads. Makes the renderer.
  std::string device();
  // Renderers made so far: acceleration structures built for images.
  unsigned builds() const { return builds_; }
  // Images that took over changed materials or lights without a new renderer.
  unsigned updates() const { return updates_; }

 private:
  void applySurfaces(const Frame& frame);
  void removeEffects(const std::vector<std::string>& off);
  Renderer& currentRenderer();
  const GroundTruth& currentTruth();
  void warnOnce(const std::string& text);

  pack::Pack pack_;   // its scene is that of the frame
  pack::Scene base_;  // without geometry and textures
  Backend backend_;
  RendererOptions options_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<GroundTruth> truth_;
  std::string surfacesKey_;             // of the scene of pack_
  std::string rendererKey_, truthKey_;  // of the scene that each has taken over
  double rotation_ = 0;                 // of the environment of pack_
  bool isEnvironmentReduced_ = false;   // effects were removed from it
  std::vector<std::string> warnings_;
  unsigned builds_ = 0, updates_ = 0;
};

}  // namespace malus::render
