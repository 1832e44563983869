#include "render/compare/timing_rounds.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

// The statistics of row i against the rows of its renderer and view.
void summarizeRow(Comparison& comparison, const RowGroup& group, std::size_t i) {
  ComparisonRow& row = comparison.rows[i];
  row.noSignificantDifference.clear();
  if (!row.ok() || row.samplesMs.empty()) return;
  row.time = computeSpread(row.samplesMs);
  for (const std::size_t j : group.rows) {
    const ComparisonRow& other = comparison.rows[j];
    if (other.backend != row.backend || !other.ok() || !other.isMain()) continue;
    if (other.samplesMs.size() != row.samplesMs.size()) continue;
    if (other.method == baselineMethod().name) row.ratioToSchlick = ratioSpread(row.samplesMs, other.samplesMs);
    if (i != j && row.isMain() && !differSignificantly(row.samplesMs, other.samplesMs))
      row.noSignificantDifference.push_back(other.method);
  }
}

}  // namespace

namespace {

// One round of a group. False: interrupted, or the time is over. The first round is for every row, so that what the
// first pass rendered has a time.
bool timeRound(Comparison& comparison, RowGroup& group, std::uint32_t round, const TimeLimit& limit) {
  for (std::size_t k = 0; k < group.rows.size(); ++k) {
    if (interrupted() || (round > 0 && limit.isOver())) return false;
    ComparisonRow& row = comparison.rows[group.rows[(k + round) % group.rows.size()]];
    if (!row.ok()) continue;
    try {
      renderTimed(row, group);
    } catch (const Interrupted&) {
      return false;
    } catch (const Error& error) {
      row.status = error.what();
    }
  }
  return true;
}

// ", about 3 min left", from the rounds that are finished; nothing before the first one.
std::string timeLeft(std::chrono::steady_clock::time_point start, std::uint32_t finished, std::uint32_t rounds) {
  if (finished == 0) return {};
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double left = seconds / finished * (rounds - finished);
  return left < 90 ? fmt::format(", about {:.0f} s left", left) : fmt::format(", about {:.0f} min left", left / 60);
}

}  // namespace

void timeRounds(Comparison& comparison, std::vector<RowGroup>& groups, std::uint32_t rounds, const TimeLimit& limit,
                const Progress& progress, const std::function<void()>& afterRound) {
  const auto start = std::chrono::steady_clock::now();
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const std::string left = timeLeft(start, round, rounds);
    for (RowGroup& group : groups) {
      progress(fmt::format("round {} of {}{}: {}", round + 1, rounds, left, groupTitle(group)));
      if (!timeRound(comparison, group, round, limit)) return;
      group.rounds = round + 1;
    }
    comparison.rounds = round + 1;
    afterRound();
  }
}

void summarizeRows(Comparison& comparison, const std::vector<RowGroup>& groups) {
  for (const RowGroup& group : groups)
    for (const std::size_t i : group.rows) {
      ComparisonRow& row = comparison.rows[i];
      for (auto* samples : {&row.samplesMs, &row.wallMs, &row.readBackMs, &row.cpuMs})
        if (row.ok()) samples->resize(std::min<std::size_t>(samples->size(), std::max(group.rounds, 1u)));
    }
  for (const RowGroup& group : groups)
    for (const std::size_t i : group.rows) summarizeRow(comparison, group, i);
}

}  // namespace malus::render
