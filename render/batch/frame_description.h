// NAME.frame.json: everything that the files of a frame in tiles depend on, apart from the pixels of the tiles and the
// manifest, so that `malus merge` writes them without the scene.
#pragma once

#include <filesystem>
#include <string>

#include "meshprep/base/image.h"
#include "render/batch/frame.h"
#include "render/batch/frame_renderer.h"
#include "render/batch/manifest.h"

namespace malus::render {

// "NAME.frame.json".
std::string frameDescriptionName(const std::string& frame);

// tile: any of the frame; its pixels are not read.
nlohmann::json describeFrame(const Frame& frame, const RenderedFrame& tile);

struct FrameDescription {
  Frame frame;             // with what writeFrame() reads
  RenderedFrame rendered;  // images have the size of the frame, and no pixels
  image::ExrCompression compression = image::ExrCompression::zip;
};

// entry: any tile of the frame. Throws Error if the file is not a description.
FrameDescription readFrameDescription(const std::filesystem::path& file, const ManifestEntry& entry);

}  // namespace malus::render
