// The timed rounds of a comparison, and the statistics of their samples.
#pragma once

#include <vector>

#include "render/compare/comparison.h"
#include "render/compare/row_group.h"

namespace malus::render {

// Renders every row once per round, each round beginning with another row, so that a drift of the machine's speed meets
// every row alike. Ends early if interrupted; sets comparison.rounds to the finished rounds.
void timeRounds(Comparison& comparison, std::vector<RowGroup>& groups, std::uint32_t rounds, const Progress& progress);

// Drops the samples of an unfinished round, then fills in the medians, ratios and sign tests of every row.
void summarizeRows(Comparison& comparison, const std::vector<RowGroup>& groups);

}  // namespace malus::render
