#include <algorithm>

#include <fmt/format.h>

#include "bake/scene_file/key_reader.h"
#include "bake/scene_file/parts.h"
#include "bake/scene_file/scene_keys.h"
#include "meshprep/base/nearest_name.h"

namespace malus::bake {
using nlohmann::json;

namespace {

Transform readTransform(StrictObject object) {
  Transform transform;
  visitTransformKeys(KeyReader(object), transform);
  for (int i = 0; i < 3; ++i)
    if (transform.scale[i] == 0) object.fail("scale", "flattens the mesh", "a number other than 0", "0");
  object.finish();
  return transform;
}

// Cleaning of a mesh, or of every part of an import.
void readCleaning(StrictObject& object, prep::Options& options) {
  visitCleaningKeys(KeyReader(object), options);
  if (!object.has("skip")) return;
  const json& skip = object.at("skip");
  if (!skip.is_array()) object.fail("skip", "must be a list", "a list of steps");
  for (const json& name : skip) {
    const auto& steps = prep::kCleaningSteps;
    const auto step = std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return name == s.first; });
    if (step == steps.end()) object.fail("skip", "names an unknown step", prep::cleaningStepNames(), name.dump());
    options.steps.*step->second = false;
  }
}

std::optional<prep::Normals> readNormals(StrictObject& object) {
  const std::string name = object.text("normals", "");
  if (name.empty()) return std::nullopt;
  if (name == "crease") return prep::Normals::crease;
  if (name == "smoothing") return prep::Normals::smoothing;
  if (name == "authored") return prep::Normals::authored;
  object.fail("normals",
              fmt::format("unknown kind of normals{}", nearestClause(name, {"crease", "smoothing", "authored"})),
              "'crease', 'smoothing' or 'authored'", fmt::format("'{}'", name));
}

// Throws Error if a key excludes simplification.
void requireSimplifiable(const StrictObject& object, const prep::Options& options) {
  const auto conflict = prep::findSimplifyConflict(options);
  if (!conflict) return;
  const char* const key = options.simplify.maxError    ? "simplifyError"
                          : options.simplify.triangles ? "simplifyTriangles"
                                                       : "simplifyNormal";
  object.fail(key, conflict->problem, conflict->expected, conflict->found);
}

// Throws Error unless the name is that of a material of the scene.
void requireMaterial(const StrictObject& object, const char* key, const std::string& name,
                     const SceneDescription& scene) {
  std::vector<std::string> names;
  for (const pack::Material& m : scene.materials) names.push_back(m.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string near = nearestName(name, names);
  object.fail(key, fmt::format("unknown material '{}'", name),
              near.empty() ? "a name under materials" : fmt::format("'{}' or another under materials", near));
}

}  // namespace

MeshDescription readMesh(StrictObject object, const SceneDescription& scene) {
  MeshDescription mesh;
  visitMeshKeys(KeyReader(object), mesh);
  mesh.file = scene.file.parent_path() / object.text("file");
  requireMaterial(object, "material", mesh.material, scene);
  readCleaning(object, mesh.preparation);
  mesh.preparation.normals = readNormals(object).value_or(prep::Normals::crease);
  requireSimplifiable(object, mesh.preparation);
  if (object.has("instances")) {
    const std::size_t count = object.listSize("instances", "a list of one transform or more");
    if (count == 0) object.fail("instances", "is empty", "a list of one transform or more");
    for (std::size_t i = 0; i < count; ++i) mesh.instances.push_back(readTransform(object.element("instances", i)));
  } else {
    mesh.instances.emplace_back();
  }
  object.finish();
  return mesh;
}

ImportDescription readImport(StrictObject object, const SceneDescription& scene) {
  ImportDescription import;
  import.file = scene.file.parent_path() / object.text("file");
  if (object.has("materials")) {
    StrictObject materials = object.object("materials");
    for (const auto& item : object.at("materials").items()) {
      const char* name = item.key().c_str();
      import.materials[name] = materials.text(name);
      requireMaterial(materials, name, import.materials[name], scene);
    }
  }
  if (object.has("transform")) import.transform = readTransform(object.object("transform"));
  readCleaning(object, import.preparation);
  import.normals = readNormals(object);
  prep::Options preparation = import.preparation;
  preparation.normals = import.normals.value_or(prep::Normals::crease);
  requireSimplifiable(object, preparation);
  const std::string key = object.resolve("openSurfaces", "sheets");
  if (object.has(key.c_str())) {
    const json& names = object.at(key.c_str());
    const auto isText = [](const json& name) { return name.is_string(); };
    if (!names.is_array() || !std::all_of(names.begin(), names.end(), isText))
      object.fail(key, "must be a list of names", "a list of strings");
    import.openSurfaces = names.get<std::vector<std::string>>();
  }
  object.finish();
  return import;
}

}  // namespace malus::bake
