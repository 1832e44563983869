// From a scene description to a scene: prepares every mesh, applies the instances' transforms, bakes the
// environment, finds the effects. Writing the pack is bake/pack/writer.h.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "bake/pack/writer.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/report.h"

namespace malus::bake {

struct Baked {
  pack::Scene scene;
  std::vector<prep::Report> reports;  // one a mesh of the description, then one a part of an import
  std::vector<std::string> notes;     // what files hold and is left out
};

// progress is told what is being done. Throws Error.
Baked bake(const SceneDescription& description, const pack::WriteSettings& settings,
           const std::function<void(std::string_view)>& progress);

// What the baker makes of the same sources changes with this number: raise it where tests/bake/golden.json changes.
inline constexpr int kBakerRevision = 2;

// JSON with the versions, the settings and the hashes of every source, and of what sources refer to: what a pack is
// made of. Throws Error for a source that cannot be read.
std::string provenanceOf(const SceneDescription& description, const pack::WriteSettings& settings);

// Whether the pack is there, whole, and made of just that.
bool isUpToDate(const std::filesystem::path& pack, const std::string& provenance);

}  // namespace malus::bake
