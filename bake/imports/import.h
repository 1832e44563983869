// Imports a whole file into a scene: prepares its parts, converts its materials (bake/materials/source_material.h)
// unless the scene names others, and makes a mesh of each instance. bake/SCENE.md has the rules of names.
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
#include "meshprep/read/source_view.h"
#include "meshprep/report.h"

namespace malus::bake {

// Unique names: a name that is taken gets a suffix ".2", ".3" and so on.
class UniqueNames {
 public:
  // Takes the name, shortened to 200 bytes, or the first free one with a suffix.
  std::string take(std::string name);

 private:
  std::map<std::string, std::size_t> used_;  // with the last number tried
};

// A part in its own space. Its mesh's sources are vertices and faces of the file; those of the report, from prepare(),
// count in the part.
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
  std::vector<prep::SourceCamera> cameras;  // if the import uses them; in the coordinates of the file
  std::vector<prep::SourceLight> lights;
  std::vector<std::string> notes;  // "model.glb: left out: textures (2); animations (1: 'run')"
};

// Adds converted materials to materials, and the textures of their maps to textures. A part that the readers or
// prepare() refuse is left out with a note, or an Error if `strict`; it is an Error too if no part is left. Throws
// Error: a file that the readers refuse as a whole, a material or an open surface of the import that the file does not
// have, more materials than a pack can contain.
Imported importScene(const ImportDescription& description, std::vector<pack::Material>& materials,
                     std::vector<pack::Texture>& textures, UniqueNames& materialNames, UniqueNames& meshNames,
                     bool strict = false);

// Notes of the readers about content that is left out or accepted, as sentences: one for all content that is left out,
// one for each other note and for each invalid part of the file.
std::vector<std::string> fileNotes(const std::filesystem::path& file, const std::vector<std::string>& notes);

}  // namespace malus::bake
