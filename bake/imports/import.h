// A whole file in a scene: its parts prepared, its materials made by rules (bake/materials/source_material.h) where
// the scene does not name others, its instances as meshes of the scene. SCENE.md says how names are found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "bake/pack/scene.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/mesh.h"
#include "meshprep/report.h"

namespace malus::bake {

// Names that are there once each: a name that is taken gets ".2", ".3" and so on behind it.
class UniqueNames {
 public:
  // The name, or the first free one that is made of it; taken from now on. Longer than 200 bytes it is shortened.
  std::string take(std::string name);

 private:
  std::map<std::string, std::size_t> used_;  // and the last number tried
};

// In its own space. Its mesh's sources are vertices and faces of the file; the report is that of prepare(), in which
// they count in the part.
struct ImportedPart {
  prep::Mesh mesh;
  prep::Report report;
};

struct ImportedMesh {
  std::string name;
  std::size_t part = 0;
  std::uint32_t material = 0;  // index into the scene's materials
  bool openSurface = false;
  glm::dmat4 worldFromObject{1.0};
};

struct Imported {
  std::vector<ImportedPart> parts;
  std::vector<ImportedMesh> meshes;
  std::vector<std::string> notes;  // "model.glb: textures are left out"
};

// Adds to materials those that are made here. Throws Error: whatever the readers and prepare() refuse, a material or
// a sheet of the import that the file does not have, more materials than a pack holds.
Imported importScene(const ImportDescription& description, std::vector<pack::Material>& materials,
                     UniqueNames& materialNames, UniqueNames& meshNames);

// What the readers leave out, as sentences for a person.
std::string noteOf(const std::filesystem::path& file, const std::string& note);

}  // namespace malus::bake
