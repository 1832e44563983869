#include "render/job.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bake/effects/effects.h"
#include "bake/pack/format.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "render/make_renderer.h"
#include "render/scene/effects_choice.h"
#include "render/scene/left_out.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return parts;
}

// Sets the size: a side that is not given follows from the other and the aspect of the scene.
void setSize(RenderParameters& parameters, const JobSettings& settings, const pack::Scene& scene) {
  const double aspect = static_cast<double>(scene.width) / scene.height;
  const auto pixels = [](double side) { return std::max(1u, static_cast<std::uint32_t>(std::lround(side))); };
  if (settings.width > 0) parameters.width = settings.width;
  if (settings.height > 0) parameters.height = settings.height;
  if (settings.width > 0 && settings.height == 0) parameters.height = pixels(settings.width / aspect);
  if (settings.height > 0 && settings.width == 0) parameters.width = pixels(settings.height * aspect);
  if (parameters.width > pack::kMaxResolution || parameters.height > pack::kMaxResolution)
    throw Error("--width, --height", "the image is too large",
                fmt::format("at most {} pixels per side", pack::kMaxResolution),
                fmt::format("{} x {}", parameters.width, parameters.height));
}

void setRegion(RenderParameters& parameters, const std::vector<std::uint32_t>& region) {
  parameters.region = {0, 0, parameters.width, parameters.height};
  if (region.empty()) return;
  parameters.region = {region[0], region[1], region[2], region[3]};
  const Region& r = parameters.region;
  if (r.width == 0 || r.height == 0 || r.x >= parameters.width || r.y >= parameters.height ||
      r.width > parameters.width - r.x || r.height > parameters.height - r.y)
    throw Error("--region", "the region is not inside the image",
                fmt::format("x y width height within {} x {}", parameters.width, parameters.height),
                fmt::format("{} {} {} {}", r.x, r.y, r.width, r.height));
}

}  // namespace

RenderParameters renderParameters(const JobSettings& settings, const pack::Scene& scene) {
  RenderParameters parameters = defaultParameters(scene);
  setSize(parameters, settings, scene);
  setRegion(parameters, settings.region);
  parameters.samples = settings.samples;
  parameters.lightSamples = settings.lightSamples;
  if (settings.depth) parameters.depth = *settings.depth;
  parameters.analyser = settings.analyser;
  parameters.everyEffect = settings.effects == "all";
  parameters.tolerance = settings.tolerance;
  parameters.stokes = settings.stokes;
  parameters.vulkanPath = settings.vulkanPath;
  parameters.embreePath = settings.embreePath;
  return parameters;
}

RenderResult renderImage(Renderer& renderer, std::string_view method, const RenderParameters& parameters,
                         bool countRays) {
  RenderResult result = renderer.render(method, parameters);
  if (countRays && result.cost.rays == 0) result.cost.rays = renderer.countRays(method, parameters);
  return result;
}

ImageChoice chooseImage(const JobSettings& settings, const RenderParameters& parameters, const pack::Scene& scene) {
  const bool hasMethods = backendInfo(settings.backend).hasMethods;
  const bool storesStokes = settings.storesStokes && hasStokes(settings.backend, settings.method, parameters);
  bake::ImageRequest request{parameters.depth, parameters.analyser, false, false};
  request.linearStokes = storesStokes || settings.needsLinear;
  request.circularStokes = storesStokes;

  const EffectsChoice effects = chooseEffects(
      splitAtCommas(settings.effects), hasMethods ? settings.method : completeRecursiveMethod().name, scene, request);
  ImageChoice choice{settings.method, {}, effects.off, {}};
  for (const EffectWarning& warning : effects.warnings)  // the reference always traces polarization
    if (hasMethods || !isPolarization(warning.effect)) choice.warnings.push_back(warning.text);
  if (hasMethods && effects.method != settings.method) {
    if (!effects.why.empty()) choice.substitutedFor = fmt::format("{}: {}", settings.method, effects.why);
    choice.method = effects.method;
  }
  return choice;
}

Job::Job(const pack::Pack& pack, const JobSettings& settings)
    : pack_(pack),
      settings_(settings),
      parameters_(renderParameters(settings, pack.scene)),
      renderers_(pack.scene, settings.backend, {settings.device, settings.threads}) {
  if (settings_.maxError || settings_.maxMs) applyBudget();
  requestedMethod_ = settings_.method;
  applyEffects();
  parameters_.checkNumerics = settings_.checkNumerics;
}

RenderResult Job::render() {
  const std::string title =
      fmt::format("rendering {} with {} {}", scene().name, backendInfo(settings_.backend).name, method());
  console::progress(title);
  Renderer& renderer = renderers_[reduced_];
  renderer.setProgress(
      [title](double fraction) { console::progress(fmt::format("{}: {:.0f} %", title, 100 * fraction)); });
  return renderImage(renderer, settings_.method, parameters_, settings_.countRays);
}

void Job::applyBudget() {
  BudgetSearch search(pack_, parameters_, renderers_, settings_.effects == "auto", settings_.threads,
                      console::progress);
  budget_ = settings_.maxMs ? search.withinTime(*settings_.maxMs) : search.withinError(*settings_.maxError);
  settings_.method = budget_->image.method;
  parameters_ = budget_->image.parameters;
  reduced_ = budget_->image.scene;
  renderers_.keepOnly(reduced_);
}

// Chooses the method and the scene for the effects that are asked for.
void Job::applyEffects() {
  const ImageChoice choice = chooseImage(settings_, parameters_, scene());
  settings_.method = choice.method;
  substitutedFor_ = choice.substitutedFor;
  warnings_ = choice.warnings;
  if (choice.off.empty()) return;
  reduced_ = leaveOut(pack_.scene, choice.off, parameters_);
  renderers_.keepOnly(reduced_);
}

}  // namespace malus::render
