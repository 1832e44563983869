// The least work that keeps an error, or the least error that keeps a time: method, effects, depth and tolerance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "render/budget/check.h"
#include "render/budget/combination.h"
#include "render/progress.h"
#include "render/renderer_pool.h"

namespace malus::render {

struct BudgetSettings {
  std::optional<double> maxError;  // relative RMS against the complete image of the same renderer (display_error.h)
  std::optional<double> maxMs;     // of tracing the image
  bool leavesOutEffects = true;    // false: the user chose the effects
  unsigned threads = 0;            // of the reference, 0 for all
};

// Part of a choice, with what it was measured to add alone.
struct BudgetPart {
  std::string what;       // "method fresnel", "without highlights", "depth 4"
  double error = 0;       // relative RMS
  double savedShare = 0;  // of the time of the complete image; negative if it takes longer
};

struct Budget {
  Combination chosen;
  PlannedImage image;             // of the chosen combination
  CheckedError checked;           // of the chosen combination
  double expectedMs = 0;          // of the image, from the small one
  double completeMs = 0;          // of the complete image, in the same way
  double precision = 0;           // error of the complete image against the double-precision reference
  std::vector<BudgetPart> parts;  // empty: the complete image
};

// Chooses by measurements of a small image (measure.h) and checks the choice on tiles of the full one; a choice that
// fails is replaced by a more careful one. pack.scene and pool: the whole scene. Throws Error if nothing keeps the
// time, naming the least that was found.
Budget findBudget(const pack::Pack& pack, const RenderParameters& full, RendererPool& pool,
                  const BudgetSettings& settings, const Progress& progress);

// The fastest combination for each of some errors, by the measurements alone: for the plot of `malus compare`.
std::vector<Combination> fastestWithin(const Measurements& measurements, const std::vector<double>& errors);

}  // namespace malus::render
