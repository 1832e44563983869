// What a pack says of its scene, as JSON: the scene.json of `malus unpack`, whose meshes and pictures lie beside it,
// and what `malus info --diff` compares. Numbers are the pack's own, relative to its origin.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"

namespace malus::bake {

// {name, title, packHash, origin, resolution, depth, exposureEv, camera, environment, lights[], materials[],
// textures[],
//  meshes[{name, file, material, sheet, vertices, triangles, map: where the pack keeps it}]}
nlohmann::json sceneJson(const pack::Pack& pack);

// Provenance is JSON that a baker wrote; a pack may come from anywhere: null where it is none. What is nested deep is
// left out, because printing it would overflow the stack.
nlohmann::json provenanceJson(const pack::Scene& scene);

// Files that it names, in the order of the pack.
std::string meshFile(std::size_t index);
std::string mapFile(std::size_t index);
std::string textureFile(std::size_t index);
inline constexpr const char* kEnvironmentFile = "environment.exr";

}  // namespace malus::bake
