#include "render/budget/budget.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/budget/measure.h"
#include "render/compare/statistics.h"
#include "render/compare/time_limit.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

using Kind = MeasuredChoice::Kind;

constexpr int kAttempts = 8;
constexpr std::size_t kTimedRounds = 3;
constexpr double kTimedMinutes = 0.01;  // no further round is started after them

std::vector<BudgetPart> describe(const Combination& c, const Measurements& m) {
  std::vector<BudgetPart> parts;
  const double completeMs = m.find(Kind::method, completeRecursiveMethod().name)->milliseconds;
  const auto add = [&](const std::string& what, const MeasuredChoice& choice) {
    parts.push_back({what, choice.error, 1 - choice.milliseconds / completeMs});
  };
  for (const MeasuredChoice& choice : m.choices) {
    if (choice.kind == Kind::method && choice.name == c.method && c.tolerance == 0 &&
        choice.name != completeRecursiveMethod().name)
      add("method " + choice.name, choice);
    if (choice.kind == Kind::tolerance && choice.name == c.method && choice.tolerance == c.tolerance)
      add(fmt::format("method {}, tolerance {:g}", choice.name, choice.tolerance), choice);
    if (choice.kind == Kind::depth && choice.depth == c.depth && c.depth != m.depth)
      add(fmt::format("depth {}", choice.depth), choice);
    if (choice.kind == Kind::effect && std::find(c.off.begin(), c.off.end(), choice.name) != c.off.end())
      add("without " + choice.name, choice);
  }
  return parts;
}

bool isComplete(const Combination& c, const Measurements& m) {
  return c.method == completeRecursiveMethod().name && c.off.empty() && c.depth == m.depth && c.tolerance == 0;
}

Combination completeCombination(const Measurements& m) {
  const MeasuredChoice* whole = m.find(Kind::method, completeRecursiveMethod().name);
  if (whole == nullptr)
    throw Error("--max-error", fmt::format("the exact method '{}' does not render", completeRecursiveMethod().name),
                "a device and depth that it can render");
  return {whole->name, {}, m.depth, 0, 0, whole->milliseconds};
}

// The fastest combination whose checked error is within the bound.
Combination chooseByError(const std::vector<Combination>& list, const Measurements& m, double maxError,
                          ErrorCheck& check, CheckedError& checked) {
  double bound = maxError;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto next = std::find_if(list.begin(), list.end(), [&](const Combination& c) { return c.error <= bound; });
    if (next == list.end() || isComplete(*next, m)) break;
    checked = check(*next);
    if (checked.relRms <= maxError) return *next;
    // Be more careful by as much as the check is above the bound.
    bound = std::min(0.8 * next->error, next->error * maxError / checked.relRms);
  }
  checked = {};
  return completeCombination(m);
}

// BudgetSearch::measuredMs
using TimeNow = std::function<double(const Combination&)>;

// The most accurate combination whose time keeps the bound, with its time now. The measured times may be of a machine
// with another load: load is the time of the complete image now, divided by the measured one. scale: pixels of the
// image over those of the small one.
Combination chooseByTime(std::vector<Combination> list, double maxMs, double scale, double load, const TimeNow& time) {
  std::stable_sort(list.begin(), list.end(),
                   [](const Combination& a, const Combination& b) { return a.error < b.error; });
  double bound = maxMs / (scale * load), least = std::numeric_limits<double>::infinity();
  const auto keepsTime = [&](Combination& c) {
    const double expected = std::exchange(c.milliseconds, time(c));
    least = std::min(least, c.milliseconds * scale);
    // Be more careful by as much as the time is above the bound.
    bound = expected * std::min(0.9, maxMs / (c.milliseconds * scale));
    return c.milliseconds * scale <= maxMs;
  };
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto next =
        std::find_if(list.begin(), list.end(), [&](const Combination& c) { return c.milliseconds <= bound; });
    if (next == list.end()) break;
    if (keepsTime(*next)) return *next;
  }
  const auto fastest = std::min_element(list.begin(), list.end(), [](const Combination& a, const Combination& b) {
    return a.milliseconds < b.milliseconds;
  });
  if (keepsTime(*fastest)) return *fastest;
  throw Error("--max-ms", fmt::format("nothing renders this image in {:g} ms", maxMs),
              fmt::format("{:.3g} or more, the least that was found, or a smaller image", least));
}

}  // namespace

BudgetSearch::BudgetSearch(const pack::Pack& pack, const RenderParameters& full, RendererPool& pool,
                           bool leavesOutEffects, unsigned threads, const Progress& progress)
    : pack_(pack),
      full_(full),
      pool_(pool),
      progress_(progress),
      measurements_(measureChoices(pack, full, pool, threads, leavesOutEffects, progress)),
      complete_(completeCombination(measurements_)),
      combinations_(combinations(measurements_, complete_.method)) {}

Budget BudgetSearch::withinError(double maxError) {
  CheckedError checked;
  Combination chosen =
      maxError > 0 ? chooseByError(combinations_, measurements_, maxError, check(), checked) : complete_;
  // The product of the shares of time is too small where much is left out, because every image traces camera rays.
  const double completeMs = measuredMs(complete_);
  chosen.milliseconds = isComplete(chosen, measurements_) ? completeMs : measuredMs(chosen);
  return makeBudget(chosen, checked, completeMs);
}

Budget BudgetSearch::withinTime(double maxMs) {
  const double completeMs = measuredMs(complete_);
  const Combination chosen = chooseByTime(combinations_, maxMs, scale(), completeMs / complete_.milliseconds,
                                          [this](const Combination& c) { return measuredMs(c); });
  return makeBudget(chosen, isComplete(chosen, measurements_) ? CheckedError() : check()(chosen), completeMs);
}

double BudgetSearch::measuredMs(const Combination& combination) {
  progress_("measuring times on a small image");
  const PlannedImage image = planImage(pack_.scene, combination, smallParameters(full_));
  const TimeLimit limit(kTimedMinutes);
  std::vector<double> samples;
  while (samples.size() < kTimedRounds && (samples.empty() || !limit.isOver()))
    samples.push_back(pool_[image.scene].render(image.method, image.parameters).cost.traceMs);
  return computeSpread(samples).median;
}

ErrorCheck& BudgetSearch::check() {
  progress_("checking the error on tiles of the image");
  if (!check_) check_.emplace(pack_.scene, complete_.method, full_, pool_);
  return *check_;
}

Budget BudgetSearch::makeBudget(const Combination& chosen, const CheckedError& checked, double completeMs) const {
  Budget budget;
  budget.chosen = chosen;
  budget.image = planImage(pack_.scene, chosen, full_);
  budget.checked = checked;
  budget.expectedMs = chosen.milliseconds * scale();
  budget.completeMs = completeMs * scale();
  budget.precision = measurements_.precision;
  budget.parts = describe(chosen, measurements_);
  budget.leftOut = measurements_.leftOut;
  return budget;
}

}  // namespace malus::render
