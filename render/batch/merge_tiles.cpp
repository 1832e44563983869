#include "render/batch/merge_tiles.h"

#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "render/batch/batch.h"
#include "render/batch/frame_description.h"
#include "render/batch/processor.h"
#include "render/batch/tile_files.h"
#include "render/batch/tiles.h"
#include "render/batch/writer.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

using Sources = std::map<EntryKey, Source>;

void requireThisProducer(const Part& part) {
  const Producer& producer = part.manifest.header.producer;
  const auto check = [&](const char* key, const std::string& expected, const std::string& found) {
    if (found != expected)
      throw Error(manifestName(part.folder),
                  fmt::format("{} is not that of this 'malus merge', which compresses the files of tiles", key),
                  fmt::format("a merge with '{}'", expected), fmt::format("'{}'", found));
  };
  check("program", producer.program, programVersion());
  check("processor", producer.processor, processorFeatures());
}

std::string tileText(const ManifestEntry& entry) {
  return fmt::format("tile {} of frame {} ('{}')", entry.tile, entry.index, entry.name);
}

Sources findTiles(const std::vector<Part>& parts) {
  const std::uint64_t frames = parts.front().manifest.header.frames;
  Sources tiles;
  for (const Part& part : parts)
    for (const auto& [key, entry] : part.manifest.entries) {
      if (entry.index >= frames)
        throw Error(manifestName(part.folder), fmt::format("frame {} is beyond the batch", entry.index),
                    fmt::format("indices under {}", frames));
      const auto [found, isNew] = tiles.emplace(key, Source{&part.folder, &entry});
      if (!isNew)
        throw Error(manifestName(part.folder),
                    fmt::format("{} is also in {}", tileText(entry), found->second.folder->string()),
                    "each tile in one folder");
    }
  return tiles;
}

// The tiles of a frame by the settings of one of them.
TileGrid readGrid(const Source& source) {
  try {
    return {settingsRegion(source.entry->settings), settingsOutputs(source.entry->settings)};
  } catch (const std::exception&) {
    throw Error(manifestName(*source.folder), fmt::format("{} has no region or outputs", tileText(*source.entry)),
                "a folder of 'malus batch --tiles'");
  }
}

// Throws Error unless the tiles are those of frame `index`: each of them, and no other.
void requireAllTiles(const Sources& tiles, std::uint64_t index, const fs::path& folder) {
  const auto begin = tiles.lower_bound({index, 0}), end = tiles.lower_bound({index + 1, 0});
  constexpr const char* kExpected = "the folders of all shards, each finished";
  if (begin == end)
    throw Error(manifestName(folder), fmt::format("no tile of frame {} is in the folders", index), kExpected);
  const std::size_t expected = readGrid(begin->second).count(),
                    found = static_cast<std::size_t>(std::distance(begin, end));
  if (const Source& last = std::prev(end)->second; last.entry->tile >= expected)
    throw Error(manifestName(*last.folder), fmt::format("{} is beyond the frame", tileText(*last.entry)),
                fmt::format("{} tiles", expected));
  if (found == expected) return;
  std::uint64_t first = 0;
  for (auto tile = begin; tile != end && tile->first.second == first; ++tile) ++first;
  throw Error(manifestName(folder),
              fmt::format("{} of {} tiles of frame {} ('{}') are in none of the folders, the first is tile {}",
                          expected - found, expected, index, begin->second.entry->name, first),
              kExpected);
}

// Throws Error unless the tile is of the same frame as the first one of it.
void requireOneFrame(const Source& first, const Source& tile) {
  const ManifestEntry &a = *first.entry, &b = *tile.entry;
  if (a.hash != b.hash || a.name != b.name || a.seed != b.seed || a.method != b.method)
    throw Error(manifestName(*tile.folder),
                fmt::format("{} has other settings than tile {} in {}", tileText(b), a.tile, first.folder->string()),
                "equal jobs and options in all shards");
  const std::size_t count = settingsOutputs(b.settings).needPixels() ? 2 : 1;
  if (b.files.size() != count || b.files[0].name != frameDescriptionName(b.name) ||
      (count == 2 && b.files[1].name != tileFileName(b.name, b.tile)))
    throw Error(manifestName(*tile.folder), fmt::format("{} has other files than a tile", tileText(b)),
                "a folder of 'malus batch --tiles'");
  if (a.files[0].hash != b.files[0].hash)
    throw Error((*tile.folder / b.files[0].name).string(), fmt::format("is not that of {}", first.folder->string()),
                a.files[0].hash, b.files[0].hash);
}

void checkTiles(const Sources& tiles, const ManifestHeader& header, const fs::path& folder) {
  for (std::uint64_t index = 0; index < header.frames; ++index) requireAllTiles(tiles, index, folder);
  std::size_t number = 0;
  const Source* first = nullptr;
  for (const auto& [key, tile] : tiles) {
    stopIfInterrupted();
    if (number++ % 100 == 0) console::progress(fmt::format("checking tile {} of {}", number, tiles.size()));
    if (key.second == 0) first = &tile;
    checkEntry(tile, header);
    requireOneFrame(*first, tile);
  }
}

// Writes the files of a frame from its tiles.
ManifestEntry mergeFrame(Sources::const_iterator begin, Sources::const_iterator end, const fs::path& to) {
  const Source& first = begin->second;
  FrameDescription frame = readFrameDescription(*first.folder / frameDescriptionName(first.entry->name), *first.entry);
  for (image::Image* image : {&frame.rendered.image, &frame.rendered.truth})
    image->pixels.resize(image->channels.size() * static_cast<std::size_t>(image->width) *
                         static_cast<std::size_t>(image->height));
  const TileGrid grid = readGrid(first);
  for (auto tile = begin; tile != end && frame.frame.outputs.needPixels(); ++tile) {
    stopIfInterrupted();
    const ManifestEntry& entry = *tile->second.entry;
    readTile(*tile->second.folder / tileFileName(entry.name, entry.tile), grid[entry.tile], frame);
  }
  return writeFrame(to, frame.frame, std::move(frame.rendered), frame.compression, first.entry->hash);
}

}  // namespace

Manifest mergeTiles(const std::vector<Part>& parts, const fs::path& to) {
  requireThisProducer(parts.front());
  Manifest merged{parts.front().manifest.header, {}};
  const Sources tiles = findTiles(parts);
  checkTiles(tiles, merged.header, parts.front().folder);
  merged.header.tileSide = 0;
  for (auto begin = tiles.begin(); begin != tiles.end();) {
    const std::uint64_t index = begin->first.first;
    const auto end = tiles.lower_bound({index + 1, 0});
    console::progress(fmt::format("merging frame {} of {}", index + 1, merged.header.frames));
    merged.entries.emplace(EntryKey{index, 0}, mergeFrame(begin, end, to));
    begin = end;
  }
  return merged;
}

}  // namespace malus::render
