// Bakes a description into a pack file, with the depth probe, reuse of the pack of an earlier bake, and warnings on the
// console: what `malus bake` and the commands that take model files share.
#pragma once

#include <filesystem>
#include <string>

#include "bake/bake.h"
#include "bake/depth_probe.h"
#include "bake/pack/writer.h"
#include "bake/scene_file/scene_file.h"

namespace malus::bake {

struct BakeJob {
  std::filesystem::path output;  // pack to write; empty: none
  pack::WriteSettings settings;
  BakeOptions options;
  MeasureDepth measure;   // empty: the light beyond the depth is not measured
  bool isForced = false;  // bakes also if the pack is up to date, and encodes every mesh again
};

struct BakedFile {
  bool isUpToDate = false;  // the pack is that of an earlier bake: of the rest, only name and warnings are set
  std::string name;         // of the scene
  std::vector<std::string> warnings;
  Baked baked;
  pack::Written written;   // empty without an output
  bool isRebaked = false;  // meshes of the earlier pack were reused
};

// Prints warnings and progress. Throws Error; then an existing pack is unchanged.
BakedFile bakeFile(const SceneDescription& description, const BakeJob& job);

}  // namespace malus::bake
