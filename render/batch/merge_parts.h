// The folders that are merged.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/batch/manifest.h"

namespace malus::render {

struct Part {
  std::filesystem::path folder;
  Manifest manifest;
};

// An entry and the folder of its files.
struct Source {
  const std::filesystem::path* folder;
  const ManifestEntry* entry;
};

// Path of the manifest, for errors.
std::string manifestName(const std::filesystem::path& folder);

// Throws Error if a folder has no manifest, two of them may not be of one batch, or their files may differ for equal
// settings.
std::vector<Part> readParts(const std::vector<std::filesystem::path>& folders);

// Throws Error if the hash of the settings, or the size or the hash of a file is not that of the entry.
void checkEntry(const Source& source, const ManifestHeader& header);

// Throws Interrupted after a signal.
void stopIfInterrupted();

}  // namespace malus::render
