#include "render/compare/paths_table.h"

#include <utility>

#include "render/scene/methods.h"

namespace malus::render {

bool hasSecondPath(Backend backend, const std::string& method) {
  const MethodInfo& info = methodNamed(method);
  return backend == Backend::vulkan ? info.isIterative : method == baselineMethod().name || info.isComplete();
}

void PathsTable::add(std::size_t index, const ComparisonRow& row, const RenderResult& rendered) {
  if (row.everyEffect || !hasSecondPath(row.backend, row.method)) return;
  methods_[row.method][pathName(row)] = {index, colours(rendered)};
}

std::vector<PathComparison> PathsTable::finish() const {
  const std::pair<const char*, const char*> pairs[] = {
      {vulkanPathName(VulkanPath::query), vulkanPathName(VulkanPath::pipeline)},
      {embreePathName(EmbreePath::packet), embreePathName(EmbreePath::scalar)}};
  std::vector<PathComparison> entries;
  for (const auto& [method, paths] : methods_)
    for (const auto& [firstName, secondName] : pairs) {
      const auto first = paths.find(firstName), second = paths.find(secondName);
      if (first == paths.end() || second == paths.end()) continue;
      PathComparison& entry = entries.emplace_back();
      entry.first = first->second.row;
      entry.second = second->second.row;
      entry.largestDifference = largestDifference(first->second.colours, second->second.colours);
    }
  return entries;
}

void summarizePaths(Comparison& comparison) {
  for (PathComparison& e : comparison.paths) {
    const std::vector<double>&first = comparison.rows[e.first].samplesMs, &second = comparison.rows[e.second].samplesMs;
    if (first.empty() || first.size() != second.size()) continue;
    e.secondToFirst = ratioSpread(second, first);
    e.differs = differSignificantly(second, first);
  }
}

}  // namespace malus::render
