// The tiles of a frame: the parts that shards render with --tiles. They depend on the frame alone, not on the shards.
#pragma once

#include <cstddef>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "render/batch/outputs.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// Pixels of a tile along each axis, except at the right and lower border. A multiple of the tiles of the renderers and
// of the patterns of sensors. A part of an image takes as many rays as it takes within the whole image.
inline constexpr std::uint32_t kFrameTileSide = 256;

class TileGrid {
 public:
  // A frame whose outputs have no pixels is one tile.
  TileGrid(const Region& region, const FrameOutputs& outputs);

  // Tiles are numbered from 0: rows from the top, within a row to the right, and from its left end on after its right
  // end. Each row begins at another column, so that every N-th tile is not always in the same columns.
  std::size_t count() const { return std::size_t{columns_} * rows_; }
  // In pixels of the whole image, as the region of the frame. Call only with tile < count().
  Region operator[](std::size_t tile) const;

 private:
  Region region_;
  std::uint32_t columns_ = 1, rows_ = 1;
};

// The region and the outputs of the settings of a frame (Frame::settings). Throw nlohmann::json::exception and Error.
Region settingsRegion(const nlohmann::json& settings);
FrameOutputs settingsOutputs(const nlohmann::json& settings);

}  // namespace malus::render
