// The first pass of a comparison: the references, every row once, and the error of every image.
#pragma once

#include <filesystem>
#include <vector>

#include "render/compare/comparison.h"
#include "render/compare/row_group.h"

namespace malus::render {

// Renders every view of every pack by the reference, then by each method on each backend, so that pipelines are
// compiled and caches are warm. Fills in comparison.references, devices, rows and effects, and writes the images to
// folder/images. A row that fails keeps its reason. Ends early if interrupted. Throws Error if the reference fails or
// an image cannot be written.
std::vector<RowGroup> warmUp(Comparison& comparison, const ComparisonSettings& settings,
                             const std::filesystem::path& folder, const Progress& progress);

}  // namespace malus::render
