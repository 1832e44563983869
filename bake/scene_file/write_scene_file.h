// Writes a description as scene.json (bake/SCENE.md), by the tables that readSceneFile() reads it by.
#pragma once

#include <filesystem>
#include <string>

#include "bake/scene_file/scene_file.h"

namespace malus::bake {

// Returns the text of the file at `path`, which names other files relative to its folder where that is possible.
// Numbers read back unchanged. The description is one that completeModel() made (bake/model/model_scene.h): materials,
// textures and meshes are those of imports, of which only the settings of cleaning and simplification are written.
std::string sceneFileText(const SceneDescription& description, const std::filesystem::path& path);

}  // namespace malus::bake
