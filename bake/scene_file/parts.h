// Parts of scene.json, each read from its object. All throw Error.
#pragma once

#include <string>

#include "bake/scene_file/scene_file.h"
#include "bake/scene_file/strict_object.h"

namespace malus::bake {

// Adds the textures that the material names to the scene.
pack::Material readMaterial(const std::string& name, StrictObject object, SceneDescription& scene);

// The materials of the scene must have been read.
MeshDescription readMesh(StrictObject object, const SceneDescription& scene);
ImportDescription readImport(StrictObject object, const SceneDescription& scene);

}  // namespace malus::bake
