#include "render/compare/choice_rows.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "render/budget/budget.h"

namespace malus::render {

namespace {

ComparisonRow makeRow(const Budget& budget, const RowGroup& group, Backend backend) {
  ComparisonRow row;
  row.scene = group.pack->scene.name;
  row.backend = backend;
  row.method = budget.image.method;
  row.width = group.parameters.width;
  row.height = group.parameters.height;
  row.depth = group.parameters.depth;
  ErrorChoice& choice = row.choice.emplace();
  for (const BudgetPart& part : budget.parts) choice.parts.push_back(part.what);
  choice.scene = budget.image.scene;
  choice.parameters = budget.image.parameters;
  return row;
}

}  // namespace

std::vector<ComparisonRow> choiceRows(RowGroup& group, Backend backend, unsigned threads, const Progress& progress) {
  const std::string title = fmt::format("{}: {}, ", groupTitle(group), backendInfo(backend).name);
  BudgetSearch search(*group.pack, group.parameters, group.renderers->pool(backend), true, threads,
                      [&](std::string_view step) { progress(title + std::string(step)); });
  std::vector<ComparisonRow> rows;
  for (const double maxError : kShownErrors) {
    ComparisonRow row = makeRow(search.withinError(maxError), group, backend);
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const ComparisonRow& other) {
      return other.method == row.method && other.choice->parts == row.choice->parts;
    });
    (same == rows.end() ? rows.emplace_back(std::move(row)) : *same).choice->maxErrors.push_back(maxError);
  }
  return rows;
}

}  // namespace malus::render
