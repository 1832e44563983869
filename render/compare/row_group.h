// Rows of a comparison that share a scene and a view: their renderers, and the render of one row.
#pragma once

#include <memory>
#include <vector>

#include "bake/pack/reader.h"
#include "render/compare/comparison.h"
#include "render/renderer_set.h"

namespace malus::render {

struct RowGroup {
  const pack::Pack* pack;
  RenderParameters parameters;
  std::shared_ptr<RendererSet> renderers;  // of the pack's scene; groups of one scene share them
  std::vector<std::size_t> rows;           // indices into Comparison::rows
  std::uint32_t rounds = 0;                // finished ones
};

// "SCENE WIDTH x HEIGHT, depth DEPTH", for progress messages.
std::string groupTitle(const RowGroup& group);

// The renderer of a row: that of its scene. Throws as makeRenderer() does.
Renderer& rowRenderer(const ComparisonRow& row, RowGroup& group);

// The parameters of a row: those of its group, with the effects and the path of the row.
RenderParameters rowParameters(const ComparisonRow& row, const RowGroup& group);

// Renders a row and appends its times to the samples of the row. Throws as Renderer::render() does.
void renderTimed(ComparisonRow& row, RowGroup& group);

// Renders a row for the first time: stores its ray count, the path taken and what was spent once (build, upload,
// compilation).
RenderResult renderFirst(ComparisonRow& row, RowGroup& group);

}  // namespace malus::render
