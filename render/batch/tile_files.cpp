#include "render/batch/tile_files.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "meshprep/json_text.h"
#include "render/batch/tiles.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kTilePart = ".tile-";

// Copies the channels of `from` to the channels of `to` from firstChannel on.
void copyChannels(const image::Image& from, std::size_t firstChannel, image::Image& to) {
  const std::size_t count = from.channels.size(), stride = to.channels.size();
  if (count == 0) return;
  for (std::size_t i = 0; i < from.pixels.size() / count; ++i)
    std::copy_n(from.pixels.data() + i * count, count, to.pixels.data() + i * stride + firstChannel);
}

// One image with the channels of both; their names differ.
image::Image joinChannels(const image::Image& a, const image::Image& b) {
  image::Image joined;
  joined.width = std::max(a.width, b.width);
  joined.height = std::max(a.height, b.height);
  joined.channels = a.channels;
  joined.channels.insert(joined.channels.end(), b.channels.begin(), b.channels.end());
  joined.pixels.resize(a.pixels.size() + b.pixels.size());
  copyChannels(a, 0, joined);
  copyChannels(b, a.channels.size(), joined);
  return joined;
}

// Copies the channels that `to` has.
void placeTile(const image::Image& tile, std::size_t x, std::size_t y, const std::string& file, image::Image& to) {
  std::vector<std::size_t> source;
  for (const std::string& name : to.channels) {
    const int channel = tile.channel(name);
    if (channel < 0) throw Error(file, fmt::format("channel '{}' is missing", name), "the file that was written");
    source.push_back(static_cast<std::size_t>(channel));
  }
  const auto width = static_cast<std::size_t>(tile.width), height = static_cast<std::size_t>(tile.height);
  const std::size_t stride = tile.channels.size(), channels = to.channels.size();
  for (std::size_t row = 0; row < height; ++row) {
    const float* from = tile.pixels.data() + row * width * stride;
    float* pixel = to.pixels.data() + ((y + row) * static_cast<std::size_t>(to.width) + x) * channels;
    for (std::size_t column = 0; column < width; ++column, from += stride, pixel += channels)
      for (std::size_t c = 0; c < channels; ++c) pixel[c] = from[source[c]];
  }
}

}  // namespace

std::string tileFileName(const std::string& frame, std::size_t tile) {
  return fmt::format("{}{}{:04}.exr", frame, kTilePart, tile);
}

bool isTileFileName(const std::string& name) {
  return name.find(kTilePart) != std::string::npos || name.ends_with(frameDescriptionName(""));
}

// The tiles of a frame follow one another: its description is written with the first of them.
const ManifestFile& TileWriter::describe(const Frame& frame, const RenderedFrame& rendered) {
  if (!described_ || described_->first != frame.index) {
    const std::string name = frameDescriptionName(frame.name);
    writeFile(folder_ / name, jsonText(describeFrame(frame, rendered)) + "\n");
    described_ = {frame.index, describeFile(folder_, name)};
  }
  return described_->second;
}

ManifestEntry TileWriter::write(const Frame& frame, std::size_t tile, const RenderedFrame& rendered,
                                const std::string& hash) {
  ManifestEntry entry{frame.index, tile, frame.name, hash, frame.seed, rendered.method, frame.settings, {}};
  entry.files.push_back(describe(frame, rendered));
  if (!frame.outputs.needPixels()) return entry;
  image::Image pixels = joinChannels(rendered.image, rendered.truth);
  const TileGrid grid(frame.region, frame.outputs);
  const Region region = grid[tile];
  pixels.attributes = {{"malus:frame", frame.name},
                       {"malus:tile", fmt::format("{} of {}", tile, grid.count())},
                       {"malus:region", fmt::format("{} {} {} {}", region.x, region.y, region.width, region.height)}};
  const std::string name = tileFileName(frame.name, tile);
  image::writeExr(folder_ / name, pixels, image::ExrCompression::zip);
  entry.files.push_back(describeFile(folder_, name));
  return entry;
}

void readTile(const fs::path& file, const Region& tile, FrameDescription& frame) {
  const image::Image pixels = image::read(file);
  const auto width = static_cast<std::uint32_t>(pixels.width), height = static_cast<std::uint32_t>(pixels.height);
  if (width != tile.width || height != tile.height)
    throw Error(file.string(), "is not the tile of the frame", fmt::format("{} x {} pixels", tile.width, tile.height),
                fmt::format("{} x {}", width, height));
  const Region& whole = frame.frame.region;
  for (image::Image* image : {&frame.rendered.image, &frame.rendered.truth})
    if (!image->channels.empty()) placeTile(pixels, tile.x - whole.x, tile.y - whole.y, file.string(), *image);
}

}  // namespace malus::render
