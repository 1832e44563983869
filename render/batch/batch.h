// Runs a batch: renders the frames of a folder that are not finished.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "render/batch/frame.h"
#include "render/batch/frame_renderer.h"
#include "render/batch/jobs.h"
#include "render/batch/manifest.h"
#include "render/batch/shard.h"

namespace malus::render {

struct BatchSettings {
  std::filesystem::path folder;  // exists
  FrameDefaults defaults;
  std::uint64_t seed = 0;
  Shard shard;         // of the frames, or of the tiles of all frames
  bool tiles = false;  // store tiles of frames (tiles.h), which `malus merge` puts together
};

struct BatchResult {
  std::size_t rendered = 0, reused = 0;  // frames or tiles of the shard
  std::size_t tiles = 0;                 // of all frames and shards; 0 of a batch of whole frames
  double seconds = 0;                    // of rendering and writing
  unsigned builds = 0, updates = 0;      // of FrameRenderer
  double perMinute() const { return seconds > 0 ? 60 * static_cast<double>(rendered) / seconds : 0; }
};

// The version and the commit of this program.
std::string programVersion();

// Reads every job before the first frame is rendered. Reports progress to the console. Throws Error: a job that cannot
// be rendered, a folder of another batch, a file that cannot be written; Interrupted after a signal, with the frames
// that were rendered written.
BatchResult runBatch(const BatchSettings& settings, const Jobs& jobs, FrameRenderer& renderer);

}  // namespace malus::render
