// Packs of model files in the user's cache folder (cacheFolder("packs")), so that commands that read packs take models.
//
// A pack is named after the scene and a hash of its provenance: the contents of all files involved, the options, and
// the versions of malus and its baker. The packs that were used least recently are removed when all of them exceed
// kMaxCacheBytes.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bake/depth_probe.h"
#include "bake/model/model_scene.h"

namespace malus::bake {

inline constexpr std::uintmax_t kMaxCacheBytes = std::uintmax_t{4} << 30;

struct ModelPackOptions {
  ModelOptions model;
  bool allowOpenGlass = false;  // as BakeOptions
};

// Returns the pack of a model, which is baked unless the cache has it. Prints where it is, and its warnings. Throws
// Error: as describeModel() and bake(); there is no cache folder, or it is not writable.
std::filesystem::path cachedPack(const std::filesystem::path& model, const ModelPackOptions& options,
                                 const MeasureDepth& measure);

// Removes the packs in the folder that were used least recently until the others have at most `most` bytes together,
// except `kept`.
void trimPacks(const std::filesystem::path& folder, std::uintmax_t most, const std::filesystem::path& kept);

}  // namespace malus::bake
