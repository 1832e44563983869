#include "render/compare/paths_table.h"

#include "render/scene/methods.h"

namespace malus::render {

void PathsTable::add(std::size_t index, const ComparisonRow& row, const RenderResult& rendered) {
  if (row.everyEffect || rendered.vulkanPath == VulkanPath::automatic || !methodNamed(row.method).isIterative) return;
  methods_[row.method][rendered.vulkanPath] = {index, colours(rendered)};
}

std::vector<PathComparison> PathsTable::finish() const {
  std::vector<PathComparison> entries;
  for (const auto& [method, paths] : methods_) {
    const auto query = paths.find(VulkanPath::query), pipeline = paths.find(VulkanPath::pipeline);
    if (query == paths.end() || pipeline == paths.end()) continue;
    PathComparison& entry = entries.emplace_back();
    entry.query = query->second.row;
    entry.pipeline = pipeline->second.row;
    entry.largestDifference = largestDifference(query->second.colours, pipeline->second.colours);
  }
  return entries;
}

void summarizePaths(Comparison& comparison) {
  for (PathComparison& e : comparison.paths) {
    const std::vector<double>&query = comparison.rows[e.query].samplesMs,
          &pipeline = comparison.rows[e.pipeline].samplesMs;
    if (query.empty() || query.size() != pipeline.size()) continue;
    e.pipelineToQuery = ratioSpread(pipeline, query);
    e.differs = differSignificantly(pipeline, query);
  }
}

}  // namespace malus::render
