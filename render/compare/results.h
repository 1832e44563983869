// Output of a comparison: JSON, CSV and a table for the terminal.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "render/compare/comparison.h"

namespace malus::render {

// The document that tools/report reads; render/compare/RESULTS.md describes it.
nlohmann::json toJson(const Comparison& comparison, const ComparisonSettings& settings);
std::string toCsv(const Comparison& comparison);
std::string toTable(const Comparison& comparison);

}  // namespace malus::render
