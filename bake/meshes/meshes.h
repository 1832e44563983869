// Meshes of a scene: read, cleaned, certified if they are glass, and their places in world space.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>

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

// A place of a mesh, which may have several. `packed` has everything but the geometry and the map to the source.
struct PlacedMesh {
  std::shared_ptr<const prep::Mesh> source;  // in its own space
  glm::dmat4 worldFromObject{1.0};
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

// Adds the materials of imports to materials, and their textures to textures. Throws Error: a mesh that cannot be read
// or cleaned, glass that is not certified, more places than a pack can contain.
PlacedMeshes placeMeshes(const SceneDescription& description, const MeshSettings& settings,
                         std::vector<pack::Material>& materials, std::vector<pack::Texture>& textures,
                         const std::function<void(std::string_view)>& progress);

}  // namespace malus::bake
