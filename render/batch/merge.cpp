#include "render/batch/merge.h"

#include <string>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/batch/manifest.h"
#include "render/batch/merge_parts.h"
#include "render/batch/merge_tiles.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

// Every frame, in the order of the indices.
std::vector<Source> findFrames(const std::vector<Part>& parts) {
  std::vector<Source> frames(parts.front().manifest.header.frames, Source{nullptr, nullptr});
  for (const Part& part : parts)
    for (const auto& [key, entry] : part.manifest.entries) {
      const std::uint64_t index = entry.index;
      const std::string where = manifestName(part.folder);
      if (index >= frames.size())
        throw Error(where, fmt::format("frame {} is beyond the batch", index),
                    fmt::format("0 to {}", frames.size() - 1));
      if (frames[index].entry != nullptr)
        throw Error(where,
                    fmt::format("frame {} ('{}') is also in {}", index, entry.name, frames[index].folder->string()),
                    "each frame in one folder");
      frames[index] = {&part.folder, &entry};
    }
  std::size_t missing = 0, first = 0;
  for (std::size_t i = frames.size(); i-- > 0;)
    if (frames[i].entry == nullptr) ++missing, first = i;
  if (missing > 0)
    throw Error(manifestName(parts.front().folder),
                fmt::format("{} of {} frames are in none of the folders, the first has the index {}", missing,
                            frames.size(), first),
                "the folders of all shards, each finished");
  return frames;
}

void place(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  if (fs::equivalent(from, to, failed) && !failed) return;
  fs::remove(to, failed);
  fs::create_hard_link(from, to, failed);
  if (failed) writeFile(to, readFile(from));  // another file system
}

Manifest mergeFrames(const std::vector<Part>& parts, const fs::path& to) {
  const std::vector<Source> frames = findFrames(parts);
  Manifest merged{parts.front().manifest.header, {}};
  for (const Source& frame : frames) {
    stopIfInterrupted();
    if (frame.entry->index % 100 == 0)
      console::progress(fmt::format("checking frame {} of {}", frame.entry->index + 1, frames.size()));
    checkEntry(frame, merged.header);
  }
  for (const Source& frame : frames) {
    stopIfInterrupted();
    for (const ManifestFile& file : frame.entry->files) place(*frame.folder / file.name, to / file.name);
    merged.entries.emplace(entryKey(*frame.entry), *frame.entry);
  }
  return merged;
}

}  // namespace

std::size_t mergeBatches(const std::vector<fs::path>& folders, const fs::path& to) {
  const InterruptScope deferring;
  const std::vector<Part> parts = readParts(folders);
  const bool hasTiles = parts.front().manifest.header.tileSide > 0;
  const Manifest merged = hasTiles ? mergeTiles(parts, to) : mergeFrames(parts, to);
  writeManifest(to, merged);  // last: a folder without it is not a merged one
  console::progressDone();
  return merged.entries.size();
}

}  // namespace malus::render
