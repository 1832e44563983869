#include "render/compare/timing_rounds.h"

#include <algorithm>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

// The statistics of row i against the rows of its renderer and view.
void summarizeRow(Comparison& comparison, const RowGroup& group, std::size_t i) {
  ComparisonRow& row = comparison.rows[i];
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

void timeRounds(Comparison& comparison, std::vector<RowGroup>& groups, std::uint32_t rounds, const Progress& progress) {
  for (std::uint32_t round = 0; round < rounds && !interrupted(); ++round) {
    for (RowGroup& group : groups) {
      if (interrupted()) break;
      progress(fmt::format("round {} of {}: {}", round + 1, rounds, groupTitle(group)));
      for (std::size_t k = 0; k < group.rows.size() && !interrupted(); ++k) {
        ComparisonRow& row = comparison.rows[group.rows[(k + round) % group.rows.size()]];
        if (!row.ok()) continue;
        try {
          renderTimed(row, group);
        } catch (const Interrupted&) {  // the loops end by interrupted()
        } catch (const Error& error) {
          row.status = error.what();
        }
      }
    }
    if (!interrupted()) comparison.rounds = round + 1;
  }
}

void summarizeRows(Comparison& comparison, const std::vector<RowGroup>& groups) {
  for (ComparisonRow& row : comparison.rows)
    for (auto* samples : {&row.samplesMs, &row.wallMs, &row.readBackMs, &row.cpuMs})
      if (row.ok()) samples->resize(std::min<std::size_t>(samples->size(), comparison.rounds));
  for (const RowGroup& group : groups)
    for (const std::size_t i : group.rows) summarizeRow(comparison, group, i);
}

}  // namespace malus::render
