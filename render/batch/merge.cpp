#include "render/batch/merge.h"

#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/batch/manifest.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

struct Part {
  fs::path folder;
  Manifest manifest;
};

std::string manifestName(const fs::path& folder) { return (folder / kManifestFile).string(); }

// Throws Error if two parts may not be of one batch, or their files may differ for equal settings.
void requireEqual(const Part& first, const Part& other) {
  const auto check = [&](const char* key, const std::string& a, const std::string& b) {
    if (a != b)
      throw Error(manifestName(other.folder), fmt::format("{} is not that of {}", key, first.folder.string()), a, b);
  };
  const ManifestHeader &a = first.manifest.header, &b = other.manifest.header;
  check("scene", a.scene, b.scene);
  check("pack", a.pack, b.pack);
  check("seed", std::to_string(a.seed), std::to_string(b.seed));
  check("frames", std::to_string(a.frames), std::to_string(b.frames));
  check("program", a.producer.program, b.producer.program);
  check("backend", a.producer.backend, b.producer.backend);
  check("device", a.producer.device, b.producer.device);
  check("processor", a.producer.processor, b.producer.processor);
}

std::vector<Part> readParts(const std::vector<fs::path>& folders) {
  std::vector<Part> parts;
  for (const fs::path& folder : folders) {
    std::optional<Manifest> manifest = readManifest(folder);
    if (!manifest) throw Error(manifestName(folder), "is missing", "a folder of 'malus batch'");
    parts.push_back({folder, std::move(*manifest)});
    requireEqual(parts.front(), parts.back());
  }
  return parts;
}

// A frame and the folder of its files.
struct Source {
  const fs::path* folder;
  const ManifestEntry* entry;
};

// Every frame, in the order of the indices.
std::vector<Source> findFrames(const std::vector<Part>& parts) {
  std::vector<Source> frames(parts.front().manifest.header.frames, Source{nullptr, nullptr});
  for (const Part& part : parts)
    for (const auto& [index, entry] : part.manifest.entries) {
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

void checkFrame(const Source& source, const ManifestHeader& header) {
  const ManifestEntry& entry = *source.entry;
  const std::string hash = frameHash(entry.settings, header.pack, header.producer.program);
  if (hash != entry.hash)
    throw Error(manifestName(*source.folder),
                fmt::format("the hash of frame {} is not that of its settings", entry.index), hash, entry.hash);
  for (const ManifestFile& file : entry.files) {
    const ManifestFile found = describeFile(*source.folder, file.name);
    if (found.bytes != file.bytes || found.hash != file.hash)
      throw Error((*source.folder / file.name).string(), "is not the file of the manifest",
                  fmt::format("{} bytes, hash {}", file.bytes, file.hash),
                  fmt::format("{} bytes, hash {}", found.bytes, found.hash));
  }
}

void place(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  if (fs::equivalent(from, to, failed) && !failed) return;
  fs::remove(to, failed);
  fs::create_hard_link(from, to, failed);
  if (failed) writeFile(to, readFile(from));  // another file system
}

void stopIfInterrupted() {
  if (interrupted()) throw Interrupted();
}

}  // namespace

std::size_t mergeBatches(const std::vector<fs::path>& folders, const fs::path& to) {
  const InterruptScope deferring;
  const std::vector<Part> parts = readParts(folders);
  const std::vector<Source> frames = findFrames(parts);
  Manifest merged{parts.front().manifest.header, {}};
  for (const Source& frame : frames) {
    stopIfInterrupted();
    if (frame.entry->index % 100 == 0)
      console::progress(fmt::format("checking frame {} of {}", frame.entry->index + 1, frames.size()));
    checkFrame(frame, merged.header);
  }
  for (const Source& frame : frames) {
    stopIfInterrupted();
    for (const ManifestFile& file : frame.entry->files) place(*frame.folder / file.name, to / file.name);
    merged.entries.emplace(frame.entry->index, *frame.entry);
  }
  writeManifest(to, merged);  // last: a folder without it is not a merged one
  console::progressDone();
  return frames.size();
}

}  // namespace malus::render
