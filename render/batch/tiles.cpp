#include "render/batch/tiles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <vector>

namespace malus::render {

namespace {

// Fractional parts of multiples of the golden ratio are evenly distributed: Knuth, The Art of Computer Programming 3,
// section 6.4.
std::uint32_t firstColumn(std::uint32_t row, std::uint32_t columns) {
  constexpr std::uint32_t kGoldenFraction = 0x9e3779b9u;  // of 2^32
  return static_cast<std::uint32_t>(std::uint64_t{row * kGoldenFraction} * columns >> 32);
}

}  // namespace

TileGrid::TileGrid(const Region& region, const FrameOutputs& outputs) : region_(region) {
  if (!outputs.needPixels()) return;
  columns_ = (region.width + kFrameTileSide - 1) / kFrameTileSide;
  rows_ = (region.height + kFrameTileSide - 1) / kFrameTileSide;
}

Region TileGrid::operator[](std::size_t tile) const {
  assert(tile < count());
  if (count() == 1) return region_;
  const auto row = static_cast<std::uint32_t>(tile / columns_);
  const std::uint32_t column = static_cast<std::uint32_t>(tile % columns_ + firstColumn(row, columns_)) % columns_;
  const std::uint32_t x = column * kFrameTileSide, y = row * kFrameTileSide;
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
