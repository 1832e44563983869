// The first pass of a comparison: the references, every row once, and the error of every image.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "render/compare/comparison.h"
#include "render/compare/row_group.h"
#include "render/compare/time_limit.h"

namespace malus::render {

// Renders every view of every pack by the reference, then by each method on each backend, so that pipelines are
// compiled and caches are warm. Fills in comparison.references, devices, rows and effects, and writes the images to
// folder/images. A row that fails keeps its reason. Ends early if interrupted; the time limit leaves out the last
// methods of a view, but not its first one, and the views that it does not reach. afterView: called after each view.
// Throws Error if the reference fails or an image cannot be written.
std::vector<RowGroup> warmUp(Comparison& comparison, const ComparisonSettings& settings, const TimeLimit& limit,
                             const std::filesystem::path& folder, const Progress& progress,
                             const std::function<void(const std::vector<RowGroup>&)>& afterView);

}  // namespace malus::render
