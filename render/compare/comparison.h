// Error against time: every method on every renderer, on the same packs, rays, depths and sizes, interleaved
// round by round in one process after a warm-up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "render/backend.h"
#include "render/compare/image_error.h"
#include "render/compare/statistics.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

struct ComparisonSettings {
  std::vector<std::string> methods;  // schlick is added where it is missing: ratios need it
  std::vector<Backend> backends = {Backend::vulkan, Backend::embree};
  std::vector<std::uint32_t> widths;   // pictures' widths; empty: the scene's times scale
  std::vector<std::uint32_t> heights;  // their heights, as many as widths; empty: by the scene's aspect
  double scale = 1;
  std::vector<std::uint32_t> depths;  // empty: the scene's
  std::uint32_t rounds = 7;
  unsigned threads = 0;
  std::string device;  // Vulkan's
  std::optional<double> polarizerDegrees;
  std::vector<std::string> gpuFamilies;  // for the compiler's static estimates: navi21, navi31, ...
};

// One method on one renderer with one view of one scene.
struct ComparisonRow {
  std::string scene, method;
  Backend backend = Backend::vulkan;
  bool everyEffect = false;  // everything compiled in; else what the picture calls for
  std::uint32_t width = 0, height = 0, depth = 0;
  std::size_t payloadBytes = 0;
  std::size_t stateBytes = 0;  // of a loop: the path at hand and those that may wait
  std::uint64_t rays = 0;
  std::vector<double> samplesMs;  // tracing alone, one a round; on Vulkan by the device's clock
  std::vector<double> wallMs, cpuMs, readBackMs;
  double buildMs = 0, uploadMs = 0, compileMs = 0;
  Spread time;                                 // of samplesMs
  Spread ratioToSchlick;                       // of the same rounds
  std::vector<std::string> indistinguishable;  // methods that the rounds do not tell apart from this one
  ImageError error;
  std::string status = "ok";  // or why it failed
  std::string picture;        // file name under pictures/
  bool ok() const { return status == "ok"; }
};

struct ComparisonReference {
  std::string scene;
  std::uint32_t width = 0, height = 0, depth = 0;
  std::string picture;
};

// What it saves to simulate only what a scene calls for: the exact intensity by `stokes` with everything compiled in,
// by the cheapest exact method that the effects allow (--effects auto), and by `importance`. Rows of one renderer and
// view, by their place in Comparison::rows; kNoRow where one is missing or failed.
struct EffectsComparison {
  static constexpr std::size_t kNoRow = ~std::size_t{0};
  std::size_t all = kNoRow, automatic = kNoRow, importance = kNoRow;
  std::string why;                         // why auto takes another method than `stokes`; empty: it does not
  Spread automaticToAll, importanceToAll;  // ratios of times of the same rounds
  double automaticDifference = 0, importanceDifference = 0;  // largest of any pixel and colour, against `all`
  double brightest = 0;                                      // of any pixel and colour in `all`
};

struct Comparison {
  std::map<std::string, pack::Pack> packs;     // by scene name
  std::map<std::string, std::string> devices;  // by renderer
  std::vector<ComparisonReference> references;
  std::vector<ComparisonRow> rows;
  std::vector<EffectsComparison> effects;
  nlohmann::json gpuModel = nlohmann::json::array();  // one entry a family, scene and method
  std::uint32_t rounds = 0;                           // finished ones
  bool interrupted = false;
};

// Writes every picture to folder/pictures; progress is told what is being done. A row that fails keeps its
// reason, the others go on. Within an InterruptScope, Ctrl-C ends it after the render at hand; what is
// finished is returned. Throws Error: no pack, zero rounds, a pack that cannot be read, two packs of one name.
Comparison compare(const std::vector<std::filesystem::path>& packs, const ComparisonSettings& settings,
                   const std::filesystem::path& folder, const std::function<void(std::string_view)>& progress);

}  // namespace malus::render
