// The timed rounds of a comparison, and the statistics of their samples.
#pragma once

#include <functional>
#include <vector>

#include "render/compare/comparison.h"
#include "render/compare/row_group.h"
#include "render/compare/time_limit.h"

namespace malus::render {

// Renders every row once per round, each round beginning with another row, so that a drift of the machine's speed meets
// every row alike. Ends early if interrupted or if the time is over; sets comparison.rounds to the rounds that every
// group finished. afterRound: called after each round.
void timeRounds(Comparison& comparison, std::vector<RowGroup>& groups, std::uint32_t rounds, const TimeLimit& limit,
                const Progress& progress, const std::function<void()>& afterRound);

// Drops the samples of a group's unfinished round, except the first, then fills in the medians, ratios and sign tests
// of every row. Can be repeated with more samples.
void summarizeRows(Comparison& comparison, const std::vector<RowGroup>& groups);

}  // namespace malus::render
