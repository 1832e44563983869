// The files of a tile: NAME.tile-NUMBER.exr has the channels of the rendered image and of the ground truth as 32-bit
// floats, without loss; NAME.frame.json describes the frame (frame_description.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "render/batch/frame.h"
#include "render/batch/frame_description.h"
#include "render/batch/frame_renderer.h"
#include "render/batch/manifest.h"

namespace malus::render {

// "NAME.tile-0012.exr".
std::string tileFileName(const std::string& frame, std::size_t tile);

// Whether a batch in tiles may write a file of this name, for some frame.
bool isTileFileName(const std::string& name);

class TileWriter {
 public:
  explicit TileWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Writes the files of a tile and returns its entry. Each file is complete or absent. Throws Error.
  ManifestEntry write(const Frame& frame, std::size_t tile, const RenderedFrame& rendered, const std::string& hash);

 private:
  const ManifestFile& describe(const Frame& frame, const RenderedFrame& rendered);

  std::filesystem::path folder_;
  std::optional<std::pair<std::size_t, ManifestFile>> described_;  // index of the frame, its description
};

// Copies the pixels of a tile into the images of its frame, which have the pixels of the frame. Throws Error if the
// file has another size or lacks a channel.
void readTile(const std::filesystem::path& file, const Region& tile, FrameDescription& frame);

}  // namespace malus::render
