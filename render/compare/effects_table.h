// The table of what --effects auto saves: rows of one renderer and view, collected while they are rendered.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/compare/comparison.h"
#include "render/scene/effects_choice.h"
#include "render/scene/render_result.h"

namespace malus::render {

// Path of a renderer; automatic: the renderer chooses. Each renderer reads its own field.
struct PathChoice {
  VulkanPath vulkan = VulkanPath::automatic;
  EmbreePath embree = EmbreePath::automatic;
  bool operator==(const PathChoice&) const = default;
};

// A method to render, with the effects that the scene needs or with every effect.
struct MethodVariant {
  std::string method;
  bool everyEffect = false;
  PathChoice path{};
  bool isSecondPath = false;
};

// Everything that a comparison renders: `methods`; the cheapest exact method in place of the complete recursive one;
// the complete methods once more with every effect; and some (hasSecondPath) once more by secondPath, unless that is
// automatic. path: of all others.
std::vector<MethodVariant> methodVariants(const std::vector<std::string>& methods, const EffectsChoice& cheapest,
                                          Backend backend, const PathChoice& path, const PathChoice& secondPath);

class EffectsTable {
 public:
  explicit EffectsTable(const EffectsChoice& cheapest) : cheapest_(cheapest) {}

  // Keeps the image if the table compares it. index: of the row in Comparison::rows.
  void add(std::size_t index, const ComparisonRow& row, const RenderResult& rendered);
  // The entry without its times. False if the row with every effect is missing.
  bool finish(EffectsComparison& entry) const;

 private:
  double largestDifferenceFromAll(std::size_t index) const;  // from the row with every effect

  const EffectsChoice& cheapest_;
  EffectsComparison entry_;
  std::map<std::size_t, std::vector<float>> colours_;  // by row: r, g, b of every pixel
};

// Fills in the ratios of times, from the samples of the rows.
void summarizeEffects(Comparison& comparison);

}  // namespace malus::render
