// Scene packs for Python.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>

#include <pybind11/pybind11.h>
#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "render/batch/frame_renderer.h"
#include "tools/python/bindings/image.h"

namespace malus::python {

// Options beside the settings of a frame.
struct RenderOptions {
  render::Backend backend = render::Backend::embree;
  std::string device;
  unsigned threads = 0;
  std::vector<std::uint32_t> region;
  double tolerance = 0;
  bool stokes = true;  // every Stokes channel that the method has
  bool truth = false;  // ground truth, too
};

class Scene {
 public:
  explicit Scene(pack::Pack pack) : pack_(std::move(pack)) {}

  const pack::Scene& scene() const { return pack_.scene; }
  // settings: as a line of a batch (render/batch/BATCH.md). Renderers stay for later images; calls wait for each other.
  Image render(const nlohmann::json& settings, const RenderOptions& options);

 private:
  render::FrameRenderer& renderer(const RenderOptions& options);

  pack::Pack pack_;
  std::mutex rendering_;
  std::map<std::tuple<render::Backend, std::string, unsigned>, std::unique_ptr<render::FrameRenderer>> renderers_;
};

void addScene(pybind11::module_& module);

}  // namespace malus::python
