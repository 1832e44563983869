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

struct BakeOptions {
  bool allowOpenGlass = false;  // glass that is not certified (meshprep/certify/glass.h) is a note, not an Error
};

struct Baked {
  pack::Scene scene;
  std::vector<prep::Report> reports;  // one a mesh of the description, then one a part of an import
  std::vector<std::string> notes;     // what files hold and is left out, and glass that is open
  double moved = 0;                   // metres; the most that rounding to float moves a vertex
};

// progress is told what is being done. Of the settings, provenance names all and keepMap is acted on. Throws Error.
Baked bake(const SceneDescription& description, const pack::WriteSettings& settings,
           const std::function<void(std::string_view)>& progress, const BakeOptions& options = {});

// What the baker makes of the same sources changes with this number: raise it where tests/bake/golden.json changes.
inline constexpr int kBakerRevision = 3;

// JSON with the versions, the settings and the hashes of every source, and of what sources refer to: what a pack is
// made of. Throws Error for a source that cannot be read.
std::string provenanceOf(const SceneDescription& description, const pack::WriteSettings& settings,
                         const BakeOptions& options = {});

}  // namespace malus::bake
