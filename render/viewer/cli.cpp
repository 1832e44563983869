#include "render/viewer/cli.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/effects/effects.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "meshprep/number_option.h"
#include "meshprep/output_option.h"
#include "render/batch/camera_keys.h"
#include "render/effects_option.h"
#include "render/filter_options.h"
#include "render/method_option.h"
#include "render/options.h"
#include "render/scene/methods.h"
#include "render/viewer/load_module.h"

namespace malus::render {

namespace {

struct ViewArguments {
  PackInput input;
  JobSettings job;
  FilterOptions filter;
  std::string view, compareWith, script;
  std::optional<double> exposure;
  unsigned frames = 0;
  double uiScale = 0;
  bool json = false;
};

class ProgramHost final : public viewer::Host {
 public:
  std::unique_ptr<Renderer> makeRenderer(Backend backend, const pack::Scene& scene,
                                         const RendererOptions& options) const override {
    return render::makeRenderer(backend, scene, options);
  }
  RenderParameters renderParameters(const JobSettings& settings, const pack::Scene& scene) const override {
    return render::renderParameters(settings, scene);
  }
  ImageChoice chooseImage(const JobSettings& settings, const RenderParameters& parameters,
                          const pack::Scene& scene) const override {
    return render::chooseImage(settings, parameters, scene);
  }
  PixelTruth pixelTruth(const pack::Scene& scene, const RenderParameters& parameters) const override {
    if (truthScene_ != &scene) truth_ = std::make_unique<GroundTruth>(scene, 0);
    truthScene_ = &scene;
    return truth_->render(parameters).front();
  }
  bool interrupted() const override { return malus::interrupted(); }

 private:
  mutable const pack::Scene* truthScene_ = nullptr;
  mutable std::unique_ptr<GroundTruth> truth_;
};

void checkCombinations(const ViewArguments& a) {
  if (a.frames == 0 && !a.script.empty()) throw CLI::ValidationError("--script", "needs --frames");
}

viewer::FilterState filterState(const FilterOptions& options) {
  makeAnalyser(options);  // checks the combination
  viewer::FilterState filter;
  if (options.polarizer) {
    filter.kind = viewer::FilterKind::linear;
    filter.polarizerDegrees = *options.polarizer;
  }
  if (!options.analyser.empty())
    filter.kind = options.analyser == "right" ? viewer::FilterKind::right : viewer::FilterKind::left;
  if (const std::optional<WavePlate> plate = parseWavePlate(options.wavePlate)) {
    filter.hasPlate = true;
    filter.plate = *plate;
  }
  return filter;
}

// A distance in front of the camera to orbit around: the nearest surface is not known yet, so the point of the view's
// axis that is nearest to the middle of the scene.
glm::dvec3 startPivot(const pack::Scene& scene) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const pack::Mesh& mesh : scene.meshes)
    for (const glm::dvec3& vertex : mesh.positions) {
      low = glm::min(low, vertex);
      high = glm::max(high, vertex);
    }
  const pack::Camera& camera = scene.camera;
  const double size = low.x <= high.x ? glm::length(high - low) : 1;
  const double distance = low.x <= high.x ? glm::dot((low + high) / 2.0 - camera.position, camera.forward) : 1;
  return camera.position + std::max(distance, 0.05 * size) * camera.forward;
}

viewer::ViewState startState(const ViewArguments& a, const pack::Scene& scene) {
  viewer::ViewState state;
  state.camera = scene.camera;
  // Of a camera with intrinsics: the window has square pixels and the axis in its middle.
  state.camera.pixelAspect = 1;
  state.camera.middleX = state.camera.middleY = 0;
  state.pivot = startPivot(scene);
  viewer::SideSettings& first = state.sides[0];
  first.backend = a.job.backend;
  first.method = a.job.method;
  first.effects = viewer::effectSwitches(a.job.effects, bake::findEffects(scene));
  state.sides[1] = first;
  state.isSplit = !a.compareWith.empty();
  state.sides[1].method = state.isSplit ? a.compareWith : "fresnel";
  state.depth = a.job.depth.value_or(scene.depth);
  state.samples = a.job.samples;
  state.lightSamples = a.job.lightSamples;
  state.exposureEv = a.exposure.value_or(scene.exposureEv);
  state.filter = filterState(a.filter);
  return state;
}

void runView(const ViewArguments& a) {
  checkCombinations(a);
  const viewer::Module& module = viewer::loadModule();
  const std::string file = packFile(a.input);
  pack::Pack pack = pack::read(file);
  const RenderParameters size = renderParameters(a.job, pack.scene);
  if (!a.view.empty()) pack.scene.camera = parseCamera(a.view, pack.scene, size.width, size.height, "--view");
  viewer::Request request;
  request.state = startState(a, pack.scene);
  pack.scene.camera = request.state.camera;
  request.pack = &pack;
  request.file = a.input.file;
  constexpr std::uint32_t kWidth = 1280, kHeight = 720;
  const bool isGiven = a.job.width > 0 || a.job.height > 0;
  request.width = isGiven ? size.width : kWidth;
  request.height = isGiven ? size.height : kHeight;
  request.device = a.job.device;
  request.threads = a.job.threads;
  request.uiScale = a.uiScale;
  request.frames = a.frames;
  request.script = a.script;
  request.json = a.json;
  const InterruptScope scope;
  module.run(request, ProgramHost());
}

}  // namespace

void addViewCommand(CLI::App& app) {
  auto a = std::make_shared<ViewArguments>();
  a->job.method = completeRecursiveMethod().name;
  CLI::App* command = app.add_subcommand("view", "Show a scene pack or a model file in a window, live");
  addPackInput(*command, a->input);
  addBackend(*command, a->job.backend);
  addMethod(*command, a->job.method);
  command->add_option("--compare-with", a->compareWith, "Second method, on the right of a split window")
      ->transform(methodName());
  addView(*command, a->view);
  addWidth(*command, a->job.width);
  addHeight(*command, a->job.height);
  addDepth(*command, a->job.depth);
  addSamples(*command, a->job.samples, a->job.lightSamples);
  addDevice(*command, a->job.device, a->job.threads);
  addFilterOptions(*command, a->filter);
  addEffects(*command, a->job.effects);
  addExposure(*command, a->exposure);
  command->add_option("--ui-scale", a->uiScale, "Scale of the panel (default: that of the display)")
      ->transform(numberBetween(0.5, 4));
  addFrames(*command, a->frames);
  command
      ->add_option("--script", a->script, "Camera path and changes of the view, with --frames (render/viewer/VIEW.md)")
      ->type_name("FILE");
  command->add_flag("--json", a->json, "Print times as JSON at the end");
  command->callback([a] { runView(*a); });
}

}  // namespace malus::render
