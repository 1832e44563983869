// One image from settings to pixels: size, method, effects and renderer. `render`, `sweep`, `compare` and --max-error
// share these functions, so that a setting means the same in each of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "render/budget/budget.h"
#include "render/renderer.h"
#include "render/renderer_pool.h"

namespace malus::render {

struct JobSettings {
  Backend backend = Backend::embree;
  std::string method = "fresnel";  // ignored by a backend without methods
  std::string device;              // as RendererOptions::device
  unsigned threads = 0;            // 0: all
  VulkanPath vulkanPath = VulkanPath::automatic;
  EmbreePath embreePath = EmbreePath::automatic;

  std::uint32_t width = 0, height = 0;  // in pixels; 0: the pack's, or what keeps its aspect
  std::vector<std::uint32_t> region;    // x, y, width, height in pixels; empty: the whole image
  std::uint32_t samples = 1;            // rays per pixel along each axis
  std::uint32_t lightSamples = RenderParameters{}.lightSamples;
  std::optional<std::uint32_t> depth;  // else the pack's
  Analyser analyser = kNoFilter;

  std::string effects = "auto";    // auto, all, or names of the effects to keep, separated by commas
  std::optional<double> maxError;  // choose method, effects and depth within this relative RMS error (budget.h)
  std::optional<double> maxMs;     // or within this time of tracing, in milliseconds
  double tolerance = 0;            // RenderParameters::tolerance
  bool stokes = false;             // RenderParameters::stokes
  bool needsLinear = false;        // S1 and S2 are read, for DoLP, AoLP or a mosaic
  bool storesStokes = false;       // every Stokes channel that the method has is stored
  bool checkNumerics = false;      // RenderParameters::checkNumerics
  bool countRays = false;          // count the rays even if that takes a second, untimed pass
};

// Throws Error for a size or a region that the scene does not allow.
RenderParameters renderParameters(const JobSettings& settings, const pack::Scene& scene);

// The method and the effects of an image by --effects (render/scene/effects_choice.h).
struct ImageChoice {
  std::string method;
  std::string substitutedFor;         // as Job::substitutedFor()
  std::vector<std::string> off;       // effects that are removed
  std::vector<std::string> warnings;  // as Job::warnings()
};
// Throws Error for an unknown effect.
ImageChoice chooseImage(const JobSettings& settings, const RenderParameters& parameters, const pack::Scene& scene);

// Renders once. countRays: if the renderer did not count the rays, it renders once more, untimed, to count them.
RenderResult renderImage(Renderer& renderer, std::string_view method, const RenderParameters& parameters,
                         bool countRays);

class Job {
 public:
  // Chooses size, method and effects. With maxError or maxMs, measures the choices or reads earlier measurements. pack
  // must outlive the job. Throws Error: a size, region or effect that does not exist, nothing within maxMs.
  Job(const pack::Pack& pack, const JobSettings& settings);
  Job(pack::Pack&& pack, const JobSettings& settings) = delete;

  // Reports progress to the console. Throws as Renderer::render() does.
  RenderResult render();

  Backend backend() const { return settings_.backend; }
  // The method that renders; "reference" if the backend has no methods.
  std::string method() const { return methodName(settings_.backend, settings_.method); }
  // The method that was asked for or that the budget chose, before --effects.
  const std::string& requestedMethod() const { return requestedMethod_; }
  // "METHOD: reason" if an exact, cheaper method replaces the one that was asked for; else empty.
  const std::string& substitutedFor() const { return substitutedFor_; }
  const RenderParameters& parameters() const { return parameters_; }
  // The scene that is rendered: the pack's, or a copy if effects are removed from it.
  const pack::Scene& scene() const { return reduced_ ? *reduced_ : pack_.scene; }
  // Effects that the scene needs and that are left out, with a bound of the error.
  const std::vector<std::string>& warnings() const { return warnings_; }
  // The choice by maxError or maxMs.
  const std::optional<Budget>& budget() const { return budget_; }

 private:
  void applyBudget();
  void applyEffects();

  const pack::Pack& pack_;
  JobSettings settings_;
  RenderParameters parameters_;
  std::shared_ptr<const pack::Scene> reduced_;  // the scene without the removed effects; null if none is removed
  RendererPool renderers_;
  std::string requestedMethod_, substitutedFor_;
  std::vector<std::string> warnings_;
  std::optional<Budget> budget_;
};

}  // namespace malus::render
