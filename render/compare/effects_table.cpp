#include "render/compare/effects_table.h"

#include <algorithm>

#include "render/compare/image_error.h"
#include "render/compare/paths_table.h"
#include "render/scene/methods.h"

namespace malus::render {

std::vector<MethodVariant> methodVariants(const std::vector<std::string>& methods, const EffectsChoice& cheapest,
                                          Backend backend, const PathChoice& path, const PathChoice& secondPath) {
  const auto contains = [&](std::string_view name) {
    return std::find(methods.begin(), methods.end(), name) != methods.end();
  };
  std::vector<MethodVariant> variants;
  variants.reserve(2 * methods.size() + 3);
  for (const std::string& method : methods) variants.push_back({method, false, path});
  if (contains(completeRecursiveMethod().name) && !contains(cheapest.method))
    variants.push_back({cheapest.method, false, path});
  for (const MethodInfo& m : render::methods())
    if (m.isComplete() && contains(m.name)) variants.push_back({m.name, true, path});
  if (secondPath == PathChoice{}) return variants;
  for (const std::string& method : methods)
    if (hasSecondPath(backend, method)) variants.push_back({method, false, secondPath, true});
  return variants;
}

void EffectsTable::add(std::size_t index, const ComparisonRow& row, const RenderResult& rendered) {
  if (row.isSecondPath) return;
  const MethodInfo& method = methodNamed(row.method);
  const bool isAll = row.everyEffect && !method.isIterative,
             isAutomatic = !row.everyEffect && row.method == cheapest_.method,
             isImportance = !row.everyEffect && method.isIterative && method.isComplete();
  if (isAll) entry_.all = index;
  if (isAutomatic) entry_.automatic = index;
  if (isImportance) entry_.importance = index;
  if (!isAll && !isAutomatic && !isImportance) return;
  colours_[index] = colours(rendered);
}

double EffectsTable::largestDifferenceFromAll(std::size_t index) const {
  const auto found = colours_.find(index);
  return found == colours_.end() ? 0 : largestDifference(found->second, colours_.at(entry_.all));
}

bool EffectsTable::finish(EffectsComparison& entry) const {
  if (entry_.all == EffectsComparison::kNoRow) return false;
  entry = entry_;
  entry.why = cheapest_.why;
  entry.automaticDifference = largestDifferenceFromAll(entry_.automatic);
  entry.importanceDifference = largestDifferenceFromAll(entry_.importance);
  const std::vector<float>& all = colours_.at(entry_.all);
  entry.brightest = *std::max_element(all.begin(), all.end());
  return true;
}

void summarizeEffects(Comparison& comparison) {
  for (EffectsComparison& e : comparison.effects) {
    const auto ratio = [&](std::size_t i) {
      if (i == EffectsComparison::kNoRow) return Spread{};
      const std::vector<double>&a = comparison.rows[i].samplesMs, &b = comparison.rows[e.all].samplesMs;
      return a.empty() || a.size() != b.size() ? Spread{} : ratioSpread(a, b);
    };
    e.automaticToAll = ratio(e.automatic);
    e.importanceToAll = ratio(e.importance);
  }
}

}  // namespace malus::render
