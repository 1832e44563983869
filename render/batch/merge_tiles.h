// Joins shards in tiles.
#pragma once

#include <filesystem>
#include <vector>

#include "render/batch/merge_parts.h"

namespace malus::render {

// Checks that every tile of every frame is in one of the parts, made with equal settings, and that its files have their
// sizes and hashes. Then writes the files of the frames, as the batch without tiles does, into `to`. Returns the
// manifest of that batch. The compression of files depends on the processor: Throws Error if this program or processor
// is not that of the parts, and, before anything is written, for everything else; Interrupted after a signal.
Manifest mergeTiles(const std::vector<Part>& parts, const std::filesystem::path& to);

}  // namespace malus::render
