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
  std::size_t leftOut = 0;        // Measurements::leftOut
};

// Chooses for one image by measurements of a small one (measure.h), and checks each choice on tiles of the full image;
// a choice that fails is replaced by a more careful one.
class BudgetSearch {
 public:
  // Measures, or reads earlier measurements. pack.scene and pool: the whole scene; both must outlive the search.
  // leavesOutEffects: false if the user chose the effects. threads: of the reference, 0 for all. Throws Error if the
  // complete method does not render.
  BudgetSearch(const pack::Pack& pack, const RenderParameters& full, RendererPool& pool, bool leavesOutEffects,
               unsigned threads, const Progress& progress);

  // The fastest within a relative RMS error, 0 or more, against the complete image of the same renderer
  // (display_error.h).
  Budget withinError(double maxError);
  // The most accurate within a time of tracing the image, in milliseconds, by times that are measured again, because
  // cached ones are of another load of the machine. Throws Error if nothing keeps it, naming the least that was found.
  Budget withinTime(double maxMs);

 private:
  ErrorCheck& check();
  // Time of a combination on the small image, as the machine is now.
  double measuredMs(const Combination& combination);
  // completeMs: time of the complete small image.
  Budget makeBudget(const Combination& chosen, const CheckedError& checked, double completeMs) const;
  double scale() const { return measurements_.fullPixels / measurements_.measuredPixels; }

  const pack::Pack& pack_;
  RenderParameters full_;
  RendererPool& pool_;
  Progress progress_;
  Measurements measurements_;
  Combination complete_;
  std::vector<Combination> combinations_;  // fastest first
  std::optional<ErrorCheck> check_;        // made when it is first needed
};

}  // namespace malus::render
