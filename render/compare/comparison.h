// Error against time: every method on every renderer, on the same packs, rays, depths and sizes, interleaved round by
// round in one process after a warm-up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "render/backend.h"
#include "render/compare/image_error.h"
#include "render/compare/statistics.h"
#include "render/progress.h"
#include "render/scene/embree_path.h"
#include "render/scene/render_parameters.h"
#include "render/scene/vulkan_path.h"

namespace malus::render {

struct ComparisonSettings {
  std::vector<std::string> methods;  // baselineMethod() is added if it is missing: ratios relate to it
  std::vector<Backend> backends = {Backend::vulkan, Backend::embree};
  std::vector<std::uint32_t> widths;   // of the images, in pixels; empty: the scene's times scale
  std::vector<std::uint32_t> heights;  // as many as widths; empty: by the scene's aspect
  double scale = 1;
  std::vector<std::uint32_t> depths;  // empty: the scene's
  std::uint32_t rounds = 7;
  double minutes = 0;  // time limit: images and rounds that it leaves no time for are left out; 0: none
  // Minutes for the first pass of a view on a Vulkan device that is a CPU (lavapipe), which may compile a method for
  // minutes; methods that it leaves no time for are left out, with a warning. 0: no limit.
  double compileMinutes = 0;
  unsigned threads = 0;                           // 0: all
  std::string device;                             // as RendererOptions::device
  VulkanPath vulkanPath = VulkanPath::automatic;  // automatic: iterative methods by each path that the device has
  EmbreePath embreePath = EmbreePath::automatic;  // automatic: schlick and complete methods by each path
  std::optional<double> polarizerDegrees;         // filter in front of the camera
  std::vector<std::string> gpuFamilies;           // for a compiler's static estimates: navi21, navi31, ...
};

// Errors for which a comparison shows what `malus render --max-error` chooses.
inline constexpr double kShownErrors[] = {0.001, 0.01, 0.05};

// A row with less work than the image needs, as --max-error chooses it.
struct ErrorChoice {
  std::vector<double> maxErrors;   // for which it is chosen
  std::vector<std::string> parts;  // "method fresnel", "without highlights", "depth 4"; empty: the whole image
  std::shared_ptr<const pack::Scene> scene;  // without effects; null: the whole one
  RenderParameters parameters;               // of the image
  double displayError = 0;                   // relative RMS, clamped at the display's white, which maxErrors bound
};

// One method on one renderer with one view of one scene.
struct ComparisonRow {
  std::string scene, method;
  Backend backend = Backend::vulkan;
  bool everyEffect = false;                       // every effect is compiled in; else those that the image needs
  VulkanPath vulkanPath = VulkanPath::automatic;  // of the Vulkan renderer: the path taken
  EmbreePath embreePath = EmbreePath::automatic;  // of the Embree renderer: the path taken
  bool isSecondPath = false;                      // a method once more, by the path that is not taken automatically
  std::optional<ErrorChoice> choice;              // a choice of --max-error, not a method
  std::string withoutRecursion;                   // as RenderResult::withoutRecursion
  std::uint32_t width = 0, height = 0, depth = 0;
  std::size_t payloadBytes = 0;  // per ray: of a recursive method, or a hit record
  std::size_t stateBytes = 0;    // per pixel, of an iterative method: the current path and the stack of waiting paths
  std::uint64_t rays = 0;
  std::vector<double> samplesMs;  // tracing alone, one per round; on Vulkan by the device's clock
  std::vector<double> wallMs, cpuMs, readBackMs;
  double buildMs = 0, uploadMs = 0, compileMs = 0;
  Spread time;                                       // of samplesMs
  Spread ratioToSchlick;                             // round by round
  std::vector<std::string> noSignificantDifference;  // methods whose times do not differ significantly
  ImageError error;                                  // of the method: against the exact method on the same renderer
  ImageError errorToReference;          // of method and precision together: against the double-precision reference
  std::optional<ImageError> precision;  // of the precision: the exact method on this renderer against the reference
  std::string status = "ok";            // or the reason of the failure
  std::string image;                    // file name in images/
  bool ok() const { return status == "ok"; }
  // Rows that are compared by method: one per method, renderer and view.
  bool isMain() const { return !everyEffect && !isSecondPath && !choice; }
};

// Of the renderer that rendered the row; "auto" if it failed.
inline const char* pathName(const ComparisonRow& row) {
  return row.backend == Backend::embree ? embreePathName(row.embreePath) : vulkanPathName(row.vulkanPath);
}

struct ComparisonReference {
  std::string scene;
  std::uint32_t width = 0, height = 0, depth = 0;
  std::string image;  // file name in images/
};

// The saving if only the effects that a scene needs are simulated: exact intensity by the complete recursive method
// with every effect, by the cheapest exact method that --effects auto allows, and by `importance`. Rows of one renderer
// and view, as indices into Comparison::rows; kNoRow if a row is missing or failed.
struct EffectsComparison {
  static constexpr std::size_t kNoRow = ~std::size_t{0};
  std::size_t all = kNoRow, automatic = kNoRow, importance = kNoRow;
  std::string why;                                           // reason if auto takes another method; else empty
  Spread automaticToAll, importanceToAll;                    // ratios of times, round by round
  double automaticDifference = 0, importanceDifference = 0;  // largest of any pixel and colour, from `all`
  double brightest = 0;                                      // of any pixel and colour in `all`
};

// A method by both paths of one renderer and with one view. Indices into Comparison::rows.
struct PathComparison {
  std::size_t first = 0, second = 0;  // by ray queries and by pipelines, or by packets and by single rays
  Spread secondToFirst;               // ratio of times, round by round
  bool differs = false;               // significantly
  double largestDifference = 0;       // of any pixel and colour
};

struct Comparison {
  std::map<std::string, pack::Pack> packs;     // by scene name
  std::map<std::string, std::string> devices;  // by renderer
  std::vector<ComparisonReference> references;
  std::vector<ComparisonRow> rows;
  std::vector<EffectsComparison> effects;
  std::vector<PathComparison> paths;
  nlohmann::json gpuModel = nlohmann::json::array();  // one entry per family, scene and method
  nlohmann::json deviceInfo;                          // of the Vulkan device (vulkan::toJson); null: not used
  std::string date;                                   // of its start, as currentDate()
  std::uint32_t rounds = 0;                           // finished ones
  bool interrupted = false;
  bool timeIsOver = false;  // ended by ComparisonSettings::minutes
};

// Receives what is finished, with its statistics, after the first pass of each view and after rounds.
using Snapshot = std::function<void(const Comparison&)>;

// Writes every image to folder/images. A row that fails keeps its reason, and the others continue. Within an
// InterruptScope, Ctrl-C ends it after the current render, and what is finished is returned. Throws Error: no pack, no
// round, a pack that cannot be read, two packs of one scene.
Comparison compare(const std::vector<std::filesystem::path>& packs, const ComparisonSettings& settings,
                   const std::filesystem::path& folder, const Progress& progress, const Snapshot& snapshot = {});

}  // namespace malus::render
