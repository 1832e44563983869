// Meshes of a scene in world space: read, cleaned, certified if they are glass, and transformed.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/mesh.h"
#include "meshprep/read/source_view.h"
#include "meshprep/report.h"

namespace malus::bake {

struct MeshSettings {
  bool allowOpenGlass = false;  // glass that is not certified is a note, not an error
  bool keepMap = false;         // fill the map to the source (pack::Mesh)
  bool strict = false;          // as BakeOptions
};

// In world space, in double: positions are rounded to float after the origin is subtracted. `packed` has everything but
// the geometry.
struct PlacedMesh {
  prep::Mesh world;
  pack::Mesh packed;
  bool isGlassBody = false;  // certified as a closed body of glass
};

struct PlacedMeshes {
  std::vector<PlacedMesh> meshes;
  std::vector<prep::Report> reports;        // per mesh of the description, then per part of an import
  std::vector<std::string> notes;           // as of Baked (bake/bake.h)
  std::vector<prep::SourceCamera> cameras;  // of imports that use them
  std::vector<prep::SourceLight> lights;
};

// Adds the materials of imports to materials. Throws Error: a mesh that cannot be read or cleaned, glass that is not
// certified, more meshes than a pack can contain.
PlacedMeshes placeMeshes(const SceneDescription& description, const MeshSettings& settings,
                         std::vector<pack::Material>& materials, const std::function<void(std::string_view)>& progress);

}  // namespace malus::bake
