// The meshes of a scene where they stand: read, cleaned, certified where they are glass, and moved into world space.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/mesh.h"
#include "meshprep/report.h"

namespace malus::bake {

struct MeshSettings {
  bool allowOpenGlass = false;  // glass that is not certified is a note, not an error
  bool keepMap = false;         // tell where vertices and faces come from (pack::Mesh)
};

// In world space, in double: rounding to float comes after the origin is taken off. `packed` has everything but the
// geometry.
struct PlacedMesh {
  prep::Mesh world;
  pack::Mesh packed;
};

struct PlacedMeshes {
  std::vector<PlacedMesh> meshes;
  std::vector<prep::Report> reports;  // one a mesh of the description, then one a part of an import
  std::vector<std::string> notes;     // what files hold and is left out, and glass that is open
};

// Adds to materials those that imports bring. Throws Error: a mesh that cannot be read or cleaned, glass that is not
// certified, more meshes than a pack holds.
PlacedMeshes placeMeshes(const SceneDescription& description, const MeshSettings& settings,
                         std::vector<pack::Material>& materials, const std::function<void(std::string_view)>& progress);

}  // namespace malus::bake
