// Reading of glTF files of tests.
#pragma once

#include <string>
#include <string_view>

#include "meshprep/read/read_gltf.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep::test {

inline SourceScene readText(const std::string& text) {
  const TemporaryFile file(".gltf", text);
  return readGltf(file.path());
}
inline SourceScene readGlb(const GltfFile& gltf) {
  const TemporaryFile file(".glb", gltf.glb());
  return readGltf(file.path());
}
inline std::string errorIn(const GltfFile& gltf) {
  return errorMessage([&] { readGlb(gltf); });
}
inline std::string strictErrorIn(const GltfFile& gltf) {
  const TemporaryFile file(".glb", gltf.glb());
  return errorMessage([&] { readGltf(file.path(), true); });
}
// Returns the file after the value at a JSON pointer is set, or removed if null.
inline GltfFile changed(GltfFile gltf, const char* pointer, const nlohmann::json& value) {
  const nlohmann::json::json_pointer at(pointer);
  if (value.is_null())
    gltf.document[at.parent_pointer()].erase(at.back());
  else
    gltf.document[at] = value;
  return gltf;
}
// Return the error of a file with one triangle that is changed so.
inline std::string errorWith(const char* pointer, const nlohmann::json& value) {
  return errorIn(changed(triangleFile(), pointer, value));
}
inline std::string strictErrorWith(const char* pointer, const nlohmann::json& value) {
  return strictErrorIn(changed(triangleFile(), pointer, value));
}
inline bool hasNote(const SourceScene& scene, std::string_view part) {
  for (const std::string& note : scene.notes)
    if (contains(note, part)) return true;
  return false;
}

}  // namespace malus::prep::test
