#include "render/batch/merge_parts.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

std::string entryKind(const ManifestHeader& header) {
  return header.tileSide == 0 ? "whole frames (without --tiles)"
                              : fmt::format("tiles of {} pixels (--tiles)", header.tileSide);
}

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
  if (a.tileSide != b.tileSide)
    throw Error(manifestName(other.folder), fmt::format("has {}", entryKind(b)),
                fmt::format("{}, as {}", entryKind(a), first.folder.string()));
  check("device", a.producer.device, b.producer.device);
  check("processor", a.producer.processor, b.producer.processor);
}

}  // namespace

std::string manifestName(const fs::path& folder) { return (folder / kManifestFile).string(); }

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

void checkEntry(const Source& source, const ManifestHeader& header) {
  const ManifestEntry& entry = *source.entry;
  const std::string hash = frameHash(entry.settings, header.pack, header.producer.program);
  if (hash != entry.hash)
    throw Error(manifestName(*source.folder),
                fmt::format("the hash of frame {} is not that of its settings", entry.index), hash, entry.hash);
  for (const ManifestFile& file : entry.files) {
    const ManifestFile found = describeFile(*source.folder, file.name);
    if (found.bytes != file.bytes || found.hash != file.hash)
      throw Error((*source.folder / file.name).string(),
                  "is not the file of the manifest; remove it and repeat its 'malus batch'",
                  fmt::format("{} bytes, hash {}", file.bytes, file.hash),
                  fmt::format("{} bytes, hash {}", found.bytes, found.hash));
  }
}

void stopIfInterrupted() {
  if (interrupted()) throw Interrupted();
}

}  // namespace malus::render
