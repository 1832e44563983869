#include "render/batch/frame_renderer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake/depth_probe.h"
#include "bake/effects/effects.h"
#include "bake/environment/rotation.h"
#include "meshprep/base/console.h"
#include "render/ground_truth/camera_matrices.h"
#include "render/ground_truth/truth_image.h"
#include "render/image/output.h"
#include "render/make_renderer.h"
#include "render/scene/left_out.h"

namespace malus::render {

namespace {

// The geometry and the textures, which frames do not change, apart from the rest of a scene.
struct Geometry {
  std::vector<pack::Mesh> meshes;
  std::vector<pack::Instance> instances;
  std::vector<pack::Texture> textures;
};
Geometry takeGeometry(pack::Scene& scene) {
  return {std::exchange(scene.meshes, {}), std::exchange(scene.instances, {}), std::exchange(scene.textures, {})};
}
void giveGeometry(Geometry geometry, pack::Scene& scene) {
  scene.meshes = std::move(geometry.meshes);
  scene.instances = std::move(geometry.instances);
  scene.textures = std::move(geometry.textures);
}

// A copy of a scene whose meshes have names and materials only.
pack::Scene copyWithoutGeometry(pack::Scene& scene) {
  Geometry geometry = takeGeometry(scene);
  pack::Scene copy = scene;
  for (const pack::Mesh& mesh : geometry.meshes) {
    copy.meshes.emplace_back().name = mesh.name;
    copy.meshes.back().material = mesh.material;
  }
  giveGeometry(std::move(geometry), scene);
  return copy;
}

}  // namespace

FrameRenderer::FrameRenderer(pack::Pack pack, Backend backend, std::string device, unsigned threads)
    : pack_(std::move(pack)),
      base_(copyWithoutGeometry(pack_.scene)),
      backend_(backend),
      options_{std::move(device), threads},
      surfacesKey_(nlohmann::json::object().dump()) {}

// Sets the camera and the surfaces of the scene, with every effect.
void FrameRenderer::applySurfaces(const Frame& frame) {
  pack::Scene& scene = pack_.scene;
  scene.camera = frame.camera;
  scene.wavelengthsNm = frame.surfaces.wavelengthsNm;
  scene.materials = frame.surfaces.materials;
  scene.lights = frame.surfaces.lights;
  const double rotation = frame.surfaces.environmentRotationDegrees;
  if (rotation != rotation_ || isEnvironmentReduced_) {
    scene.environment = base_.environment;
    bake::rotateEnvironment(rotation, scene.environment);
    rotation_ = rotation;
    isEnvironmentReduced_ = false;
  }
  surfacesKey_ = frame.surfaceKeys.dump();
}

// As leaveOut() does on a copy. The rules change no geometry.
void FrameRenderer::removeEffects(const std::vector<std::string>& off) {
  if (off.empty() || !bake::canBeRemoved(off)) return;
  Geometry geometry = takeGeometry(pack_.scene);
  pack_.scene = bake::withoutEffects(std::move(pack_.scene), off);
  giveGeometry(std::move(geometry), pack_.scene);
  isEnvironmentReduced_ = true;
  surfacesKey_ += fmt::format(" without {}", fmt::join(off, ","));
}

Renderer& FrameRenderer::currentRenderer() {
  if (renderer_ && rendererKey_ != surfacesKey_) {
    if (renderer_->updateScene())
      ++updates_;
    else
      renderer_.reset();
  }
  rendererKey_.clear();  // if the next call throws, the renderer has no known scene
  if (!renderer_) {
    renderer_ = makeRenderer(backend_, pack_.scene, options_);
    ++builds_;
  }
  rendererKey_ = surfacesKey_;
  return *renderer_;
}

const GroundTruth& FrameRenderer::currentTruth() {
  if (truth_ && truthKey_ != surfacesKey_ && !truth_->updateScene()) truth_.reset();
  if (!truth_) truth_ = std::make_unique<GroundTruth>(pack_.scene, options_.threads);
  truthKey_ = surfacesKey_;
  return *truth_;
}

void FrameRenderer::warnOnce(const std::string& text) {
  if (text.empty() || std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end()) return;
  warnings_.push_back(text);
  console::warn(text);
}

std::string FrameRenderer::device() {
  if (!renderer_) currentRenderer();
  const std::string text = renderer_->device();
  return backend_ == Backend::embree ? text.substr(0, text.find(',')) : text;
}

RenderedFrame FrameRenderer::render(const Frame& frame, const Region& part) {
  applySurfaces(frame);
  RenderParameters parameters = renderParameters(frame.job, pack_.scene);
  const ImageChoice choice = chooseImage(frame.job, parameters, pack_.scene);
  for (const std::string& warning : choice.warnings) warnOnce(warning);
  warnOnce(bake::lostLightNote(pack_.scene.lightBeyond, parameters.depth, "depth"));
  switchOff(choice.off, parameters);
  removeEffects(choice.off);

  RenderedFrame rendered;
  rendered.method = methodName(backend_, choice.method);
  rendered.camera = cameraJson(pack_.scene, parameters);
  RenderParameters traced = parameters;
  traced.region = part;
  if (frame.outputs.needImage()) {
    RenderResult result = currentRenderer().render(choice.method, traced);
    rendered.traceMs = result.cost.traceMs;
    result.device = device();  // on which files depend, unlike the number of threads
    rendered.image = takeImage(result, pack_, parameters, backendInfo(backend_).name, rendered.method);
  }
  if (frame.outputs.has(FrameOutput::truth))
    rendered.truth = truthImage(currentTruth().render(traced), pack_, parameters, part);
  return rendered;
}

}  // namespace malus::render
