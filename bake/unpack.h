// Unpacks a scene pack into files that other programs read: scene.json, a binary PLY per mesh, and the environment's
// octahedral map and the textures as EXR. Texture coordinates are the properties s, t and s1, t1 of vertices, with v
// down as in the pack; tangents are tx, ty, tz, tw. Numbers are those of the pack, relative to its origin and not
// rounded.
//
// scene.json has the fields of the pack by their names in bake/FORMAT.md: name, title, origin, depth, exposureEv,
// camera {...}, lights [{type, ...}], materials [{...}], textures [{..., file}], with packHash, resolution [width,
// height], environment {radiance} or {image, size}, and meshes [{name, file, material, openSurface, vertices,
// triangles}], with map if the pack has the map to the sources: a JSON file {vertices[], triangles[]} with the vertex
// and the face of the source file, from 0, of each vertex and triangle. It cannot be baked again: normals and
// transforms are baked in.
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"

namespace malus::bake {

// The files that unpack() writes into folder.
std::vector<std::filesystem::path> unpackedFiles(const pack::Pack& pack, const std::filesystem::path& folder);

// Writes into folder, which is created if it is missing. Returns the document of scene.json. Replaces the files of an
// earlier unpack() there, and no others. Throws Error: a file that is there is of another origin, or cannot be written.
nlohmann::json unpack(const pack::Pack& pack, const std::filesystem::path& folder);

}  // namespace malus::bake
