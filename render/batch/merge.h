// Joins the folders of the shards of a batch.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace malus::render {

// Checks that the folders are parts of one batch, by one program on processors of equal features, that every frame is
// in one of them, with the hash of its settings, and that every file has its size and hash. Then puts all files into
// `to`, which exists, as hard links or, on another file system, as copies, and writes one manifest. Frames in tiles are
// put together and written (merge_tiles.h). Returns the number of frames. Throws Error, before anything is written, for
// anything else; Interrupted after a signal.
std::size_t mergeBatches(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& to);

}  // namespace malus::render
