// Texts of scene.json for tests: a minimal scene, and its errors when it is changed.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/scene_file/scene_file.h"
#include "tests/bake/fixtures.h"

namespace malus::bake::test {

// A scene with the required keys only.
inline nlohmann::json minimal() {
  return nlohmann::json::parse(R"({
    "malus": 1, "name": "plain",
    "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "verticalFovDegrees": 30},
    "resolution": [64, 48], "depth": 4,
    "materials": {"floor": {"type": "lambert", "albedo": 0.5}},
    "meshes": [{"name": "floor", "file": "floor.obj", "material": "floor"}]})");
}

inline SceneDescription readText(const std::string& text) {
  const TemporaryFolder folder;
  return readSceneFile(folder.write("scene.json", text));
}

inline SceneDescription readJson(const nlohmann::json& value) { return readText(value.dump()); }

// Returns the error of the minimal scene with the value at a JSON pointer set to this JSON text, or removed.
inline std::string errorWith(const char* pointer, const char* value) {
  nlohmann::json scene = minimal();
  if (value == nullptr) {
    const nlohmann::json::json_pointer at(pointer);
    scene[at.parent_pointer()].erase(at.back());
  } else {
    scene[nlohmann::json::json_pointer(pointer)] = nlohmann::json::parse(value);
  }
  return errorMessage([&] { readJson(scene); });
}

inline std::string errorOfMaterial(const char* value) { return errorWith("/materials/floor", value); }

}  // namespace malus::bake::test
