// Gain and cost of each effect and bounce: the image without it against the complete image of the same renderer, error
// and time, in interleaved rounds.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "render/ablation/variants.h"
#include "render/backend.h"
#include "render/compare/image_error.h"
#include "render/compare/statistics.h"
#include "render/job.h"
#include "render/progress.h"

namespace malus::render {

struct AblationSettings {
  std::vector<Backend> backends = {Backend::embree, Backend::vulkan};
  JobSettings image;  // size, depth, filter, device, threads and paths; without a size kAblationSide
  std::uint32_t rounds = 7;
  double minutes = 10;  // time limit: rows and rounds that it leaves no time for are left out; 0: none
};
inline constexpr std::uint32_t kAblationSide = 512;  // pixels of the longer side of the image

struct AblationRow {
  std::string scene;
  Backend backend = Backend::embree;
  VariantKind kind = VariantKind::complete;
  std::string name;    // Variant::name
  std::string method;  // the complete one, or that without the polarization
  std::uint32_t width = 0, height = 0, depth = 0;
  ImageError error;               // against the complete image of the same renderer
  std::uint64_t rays = 0;         // of the image
  std::uint64_t savedRays = 0;    // that the complete image traces more
  std::int64_t savedBytes = 0;    // of the state per ray that the complete image needs more
  double firstMs = 0;             // tracing alone, of the first pass
  std::vector<double> samplesMs;  // the same, one per round
  Spread time;                    // of samplesMs
  Spread ratioToComplete;         // of times, round by round
  bool differs = false;           // significantly, in time
  std::string status = "ok";      // or the reason of the failure
  std::string image;              // file name in images/
  bool ok() const { return status == "ok"; }
};

// Light of the bounces between two measured depths, the larger of which may be that of the complete image.
struct BounceStep {
  std::size_t shorter = 0, deeper = 0;  // indices into Ablation::rows
  double relRms = 0;                    // of their difference, relative to the complete image
  Spread timeRatio;                     // deeper over shorter, round by round
  bool differs = false;                 // significantly, in time
};

struct Ablation {
  std::map<std::string, pack::Pack> packs;     // by scene name
  std::map<std::string, std::string> devices;  // by renderer
  std::vector<AblationRow> rows;               // by renderer and scene; the complete image is the first of each
  std::vector<BounceStep> bounces;
  std::string date;          // of its start, as currentDate()
  std::uint32_t rounds = 0;  // finished ones of every renderer
  std::size_t leftOut = 0;   // rows that the time limit left out
  bool interrupted = false;
  bool timeIsOver = false;  // ended by AblationSettings::minutes
};

using AblationSnapshot = std::function<void(const Ablation&)>;

// Writes every image to folder/images. Rows of the second renderer are measured in the order of what they save on the
// first. A row that fails keeps its reason. Within an InterruptScope, Ctrl-C ends it after the current render, and what
// is finished is returned. Throws Error: no pack, no round, a pack that cannot be read, two packs of one scene.
Ablation ablate(const std::vector<std::filesystem::path>& packs, const AblationSettings& settings,
                const std::filesystem::path& folder, const Progress& progress, const AblationSnapshot& snapshot = {});

}  // namespace malus::render
