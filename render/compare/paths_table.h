// The table of the methods by both paths of a renderer, collected while the rows are rendered.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/compare/comparison.h"
#include "render/scene/render_result.h"

namespace malus::render {

// Methods that are rendered by both paths of a renderer: on Vulkan the iterative ones, whose rays and payloads are
// those of the other path; with Embree, where a path takes several times as long, the baseline and the complete ones.
bool hasSecondPath(Backend backend, const std::string& method);

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
  std::map<std::string, std::map<std::string, Rendered>> methods_;  // by method and path
};

// Fills in the ratios of times, from the samples of the rows.
void summarizePaths(Comparison& comparison);

}  // namespace malus::render
