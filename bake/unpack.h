// A scene pack taken apart into files that other programs read: scene.json, one binary PLY a mesh, and the
// environment's octahedral map as EXR. Numbers are those of the pack, relative to its origin, none rounded.
//
// scene.json: name, title, packHash, origin, resolution, depth, exposureEv; camera {position, right,
// up, forward (orthonormal), verticalFovDegrees, mediumEta}; environment {radiance} or {image, size: texels a
// side without the border of one}, with diffuseFill and irradiance[9]; lights[{type, position, intensity}];
// materials[{name, type, eta, k, outsideEta, albedo, radiance, highlight: null or {strength, exponent}}];
// meshes[{name, file, material, sheet, vertices, triangles}], with map where the pack keeps the map to the sources: a
// JSON file {vertices[], triangles[]}, the vertex and the face of the source file, from 0, of each of the mesh's. Units
// and meanings: bake/SCENE.md. It is no source for baking: normals and transforms are baked in.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"

namespace malus::bake {

// Writes into folder, which is made where it is missing. Returns the document of scene.json. Throws Error.
nlohmann::json unpack(const pack::Pack& pack, const std::filesystem::path& folder);

}  // namespace malus::bake
