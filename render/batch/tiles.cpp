#include "render/batch/tiles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <vector>

namespace malus::render {

TileGrid::TileGrid(const Region& region, const FrameOutputs& outputs) : region_(region) {
  if (!outputs.needPixels()) return;
  columns_ = (region.width + kFrameTileSide - 1) / kFrameTileSide;
  rows_ = (region.height + kFrameTileSide - 1) / kFrameTileSide;
}

Region TileGrid::operator[](std::size_t tile) const {
  assert(tile < count());
  if (count() == 1) return region_;
  const auto x = static_cast<std::uint32_t>(tile % columns_) * kFrameTileSide,
             y = static_cast<std::uint32_t>(tile / columns_) * kFrameTileSide;
  return {region_.x + x, region_.y + y, std::min(kFrameTileSide, region_.width - x),
          std::min(kFrameTileSide, region_.height - y)};
}

Region settingsRegion(const nlohmann::json& settings) {
  const auto values = settings.at("region").get<std::array<std::uint32_t, 4>>();
  return {values[0], values[1], values[2], values[3]};
}

FrameOutputs settingsOutputs(const nlohmann::json& settings) {
  return {settings.at("outputs").get<std::vector<std::string>>(), "outputs"};
}

}  // namespace malus::render
