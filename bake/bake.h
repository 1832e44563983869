// From a scene description to a scene: prepares every mesh, applies the instances' transforms, bakes the
// environment, finds the effects. Writing the pack is bake/pack/writer.h.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "bake/pack/writer.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/report.h"

namespace malus::bake {

struct Baked {
  pack::Scene scene;
  std::vector<prep::Report> reports;  // one a mesh of the description
};

// progress is told what is being done. Throws Error.
Baked bake(const SceneDescription& description, const pack::WriteSettings& settings,
           const std::function<void(std::string_view)>& progress);

}  // namespace malus::bake
