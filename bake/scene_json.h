// The contents of a pack as JSON, from the descriptions of its records (bake/pack/record_fields.h, material_fields.h):
// the scene.json that `malus unpack` writes beside meshes and images, and what `malus info --diff` compares. Positions
// are relative to the origin, as in the pack.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"

namespace malus::bake {

// {name, title, packHash, origin, resolution, depth, exposureEv, camera, environment, lights[], materials[],
//  textures[], meshes[{name, file, material, openSurface, vertices, triangles, map: if the pack has it}]}
nlohmann::json sceneJson(const pack::Pack& pack);

// {name, type, eta, k, ..., highlight: null without one}; the fields of SRFX unless the material is plain.
nlohmann::json materialJson(const pack::Material& material);

// [{name, on, reason}]
nlohmann::json effectsJson(const std::vector<pack::Effect>& effects);

// The provenance of a pack; null if it is not JSON, because a pack may come from anywhere. Nesting deeper than 32
// levels is left out, because printing it would overflow the stack.
nlohmann::json provenanceJson(const pack::Scene& scene);
// The warnings of the bake, from the provenance. Empty if the pack has none, or is of an earlier version.
std::vector<std::string> bakeWarnings(const pack::Scene& scene);

// Names of the files beside scene.json; index: that of the mesh or texture in the pack.
std::string meshFile(std::size_t index);
std::string mapFile(std::size_t index);
std::string textureFile(std::size_t index);
inline constexpr const char* kEnvironmentFile = "environment.exr";

}  // namespace malus::bake
