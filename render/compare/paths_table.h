// The table of the iterative methods by both paths of a Vulkan device, collected while the rows are rendered.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/compare/comparison.h"
#include "render/scene/render_result.h"

namespace malus::render {

// Rows of one renderer and view.
class PathsTable {
 public:
  // Keeps the image if the table compares it. index: of the row in Comparison::rows.
  void add(std::size_t index, const ComparisonRow& row, const RenderResult& rendered);
  // The entries without their times, one per method that was rendered by both paths.
  std::vector<PathComparison> finish() const;

 private:
  struct Rendered {
    std::size_t row;
    std::vector<float> colours;
  };
  std::map<std::string, std::map<VulkanPath, Rendered>> methods_;
};

// Fills in the ratios of times, from the samples of the rows.
void summarizePaths(Comparison& comparison);

}  // namespace malus::render
