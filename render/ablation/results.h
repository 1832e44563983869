// Output of an ablation: JSON and a table for the terminal.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "render/ablation/ablation.h"

namespace malus::render {

// The document that tools/report/effects_report.py reads; render/ablation/RESULTS.md describes it.
nlohmann::json toJson(const Ablation& ablation, const AblationSettings& settings);

// One table per scene and renderer, sorted by the cost per error that leaving out causes, and the advice of each row.
std::string toTable(const Ablation& ablation);

// Indices of the rows of a scene and renderer, except the complete image, by costPerError, largest first.
std::vector<std::size_t> sortedRows(const Ablation& ablation, const AblationRow& complete);

}  // namespace malus::render
