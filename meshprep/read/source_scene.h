// A file as a modeller's program leaves it: materials, parts that each have one, and where every part stands. glTF
// has all of that; OBJ has materials, whose faces are cut apart; PLY, STL and OFF are one part that stands as it is.
//
// Nothing is baked here: transforms are applied, materials given optical constants and meshes cleaned by others.
// Lengths are metres, the axes right-handed with +y up (glTF's), coordinates double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "meshprep/read/polygons.h"

namespace malus::prep {

// In the terms of glTF 2.0, whose defaults these are. Colours are linear; pictures are left out.
struct SourceMaterial {
  std::string name;  // empty where the file gives none
  glm::dvec3 baseColour{1.0};
  double metallic = 1;              // 0 to 1
  double roughness = 1;             // 0 to 1, perceptual: the square root of GGX's alpha
  glm::dvec3 emissive{0.0};         // radiance, with its strength multiplied in
  double transmission = 0;          // 0 to 1
  double ior = 1.5;                 // 1 or more
  bool hasVolume = false;           // the material has an inside, and says what it does to light:
  glm::dvec3 attenuationColour{1};  // what is left of white light after
  double attenuationDistance = std::numeric_limits<double>::infinity();  // metres
};

struct SourcePart {
  std::string name;  // empty where the file gives none
  Polygons polygons;
  std::optional<std::size_t> material;  // index into materials

  // The file's vertices and faces that its own are, where it is cut out of them; else empty.
  std::vector<std::uint32_t> fileVertices, fileFaces;
};

struct SourceInstance {
  std::size_t part = 0;
  std::string name;
  glm::dmat4 worldFromObject{1.0};  // affine and regular
};

struct SourceScene {
  std::vector<SourceMaterial> materials;
  std::vector<SourcePart> parts;
  std::vector<SourceInstance> instances;

  // What the file holds and is left out, once each: "textures".
  std::vector<std::string> notes;
};

// Adds a note that is not there yet; after 100 only "and more".
void addNote(std::vector<std::string>& notes, std::string note);

// Reads what the extension tells: .gltf, .glb, .obj, .ply, .stl, .off. Throws Error: whatever the format's reader
// refuses (read_gltf.h, read_mtl.h, read_mesh.h).
SourceScene readSourceScene(const std::filesystem::path& path);

// One part for each material that faces name, in the order in which they name it; each with the vertices that its
// faces use, in the order of the file. The materials have a name and nothing else. Without any: one part.
SourceScene splitByMaterial(Polygons polygons);

// Every instance in one piece, in world space: its parts are the instances. Faces of mirrored instances are turned,
// so that outside stays outside. Where one part has normals and another has none, the other's are zero.
Polygons merged(const SourceScene& scene);

// The files that this one refers to and that make a difference: buffers of glTF, material files of OBJ. They need not
// exist. Throws Error where the file itself cannot be read.
std::vector<std::filesystem::path> referencedFiles(const std::filesystem::path& path);

// Whether the extension is .gltf or .glb.
bool isGltf(const std::filesystem::path& path);

}  // namespace malus::prep
