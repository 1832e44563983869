// Rows of what `malus render --max-error` chooses, for the plot of error against time.
#pragma once

#include <vector>

#include "render/compare/row_group.h"
#include "render/progress.h"

namespace malus::render {

// One row for each different choice among kShownErrors, not rendered. threads: of the reference, 0 for all. Throws
// Error if the complete method does not render.
std::vector<ComparisonRow> choiceRows(RowGroup& group, Backend backend, unsigned threads, const Progress& progress);

}  // namespace malus::render
