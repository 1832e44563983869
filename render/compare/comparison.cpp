#include "render/compare/comparison.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/compare/effects_table.h"
#include "render/compare/machine.h"
#include "render/compare/packs.h"
#include "render/compare/paths_table.h"
#include "render/compare/timing_rounds.h"
#include "render/compare/warm_up.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

// Checks the settings and adds the method to which times are related.
ComparisonSettings completeSettings(ComparisonSettings settings) {
  if (settings.rounds == 0) throw Error("--rounds", "no round", "1 or more", "0");
  if (!settings.widths.empty() && !settings.heights.empty() && settings.widths.size() != settings.heights.size())
    throw Error("--height", "there must be as many heights as widths", fmt::format("{}", settings.widths.size()),
                fmt::format("{}", settings.heights.size()));
  std::vector<std::string>& names = settings.methods;
  for (const std::string& name : names) methodNamed(name);
  if (std::find(names.begin(), names.end(), baselineMethod().name) == names.end())
    names.insert(names.begin(), baselineMethod().name);
  return settings;
}

void summarize(Comparison& comparison, const std::vector<RowGroup>& groups) {
  summarizeRows(comparison, groups);
  summarizeEffects(comparison);
  summarizePaths(comparison);
}

// Reports what is finished, after rounds at most every five seconds, so that writing it does not disturb the times.
class Watch {
 public:
  explicit Watch(const Snapshot& snapshot) : snapshot_(snapshot) {}
  bool isDue() const { return snapshot_ && std::chrono::steady_clock::now() - last_ >= std::chrono::seconds(5); }
  void report(const Comparison& comparison) {
    if (snapshot_) snapshot_(comparison);
    last_ = std::chrono::steady_clock::now();
  }

 private:
  const Snapshot& snapshot_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

Comparison compare(const std::vector<std::filesystem::path>& packs, const ComparisonSettings& asked,
                   const std::filesystem::path& folder, const Progress& progress, const Snapshot& snapshot) {
  const ComparisonSettings settings = completeSettings(asked);
  Comparison comparison;
  comparison.date = currentDate();
  comparison.packs = readPacks(packs);
  const TimeLimit limit(settings.minutes);
  Watch watch(snapshot);
  const auto afterView = [&](const std::vector<RowGroup>& groups) {
    summarize(comparison, groups);
    watch.report(comparison);
  };
  std::vector<RowGroup> groups = warmUp(comparison, settings, limit, folder, progress, afterView);
  timeRounds(comparison, groups, settings.rounds, limit, progress, [&] {
    if (!watch.isDue()) return;
    summarize(comparison, groups);
    watch.report(comparison);
  });
  comparison.interrupted = interrupted();
  comparison.timeIsOver = limit.isOver() && comparison.rounds < settings.rounds;
  summarize(comparison, groups);
  return comparison;
}

}  // namespace malus::render
