#include "bake/scene_file/scene_file.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/pack/format.h"
#include "bake/scene_file/json_file.h"
#include "bake/scene_file/key_reader.h"
#include "bake/scene_file/parts.h"
#include "bake/scene_file/scene_keys.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"

namespace malus::bake {
using nlohmann::json;

namespace {

void readCamera(StrictObject object, SceneDescription& scene) {
  visitCameraKeys(KeyReader(object), scene);
  const bool fov = object.has("verticalFovDegrees"), orthographic = object.has("orthographicHeight"),
             intrinsics = object.has("intrinsics");
  if ((fov ? 1 : 0) + (orthographic ? 1 : 0) + (intrinsics ? 1 : 0) > 1)
    object.fail("verticalFovDegrees", "orthographicHeight and intrinsics exclude each other", "one of the three");
  if (orthographic) {
    visitOrthographicKeys(KeyReader(object), scene);
  } else if (intrinsics) {
    StrictObject keys = object.object("intrinsics");
    visitIntrinsicsKeys(KeyReader(keys), scene.intrinsics.emplace());
    keys.finish();
  } else {
    visitFovKeys(KeyReader(object), scene);
  }
  object.finish();
}

void readEnvironment(StrictObject object, SceneDescription& scene) {
  const bool constant = object.has("radiance"), image = object.has("image"), preset = object.has("preset");
  const int kinds = (constant ? 1 : 0) + (image ? 1 : 0) + (preset ? 1 : 0);
  if (kinds != 1)
    object.fail("radiance", "image and preset exclude each other", "one of the three", fmt::format("{}", kinds));
  KeyReader keys(object);
  if (constant) visitConstantKeys(keys, scene);
  if (image) scene.environmentImage = scene.file.parent_path() / object.text("image");
  if (preset) {
    scene.environmentPreset = object.text("preset");
    if (scene.environmentPreset != kStudioPreset)
      object.fail("preset", "unknown environment", fmt::format("'{}'", kStudioPreset),
                  fmt::format("'{}'", scene.environmentPreset));
  }
  if (!constant) visitImageKeys(keys, scene);
  visitEnvironmentKeys(keys, scene);
  keys.finish();
  object.finish();
}

pack::LightSource readLight(StrictObject object) {
  const std::string type = object.text("type");
  const auto* const found = std::ranges::find(pack::kLightKindNames, type);
  if (found == pack::kLightKindNames.end())
    object.fail("type",
                fmt::format("unknown type of light{}",
                            nearestClause(type, {pack::kLightKindNames.begin(), pack::kLightKindNames.end()})),
                "'point', 'spot' or 'directional'", fmt::format("'{}'", type));
  pack::LightSource light{};
  light.kind = static_cast<pack::LightKind>(found - pack::kLightKindNames.begin());
  KeyReader keys(object);
  if (light.kind == pack::LightKind::directional)
    visitDirectionalKeys(keys, light);
  else
    visitLightKeys(keys, light);
  if (light.kind != pack::LightKind::point) visitDirectionKeys(keys, light);
  if (light.kind == pack::LightKind::spot) {
    visitSpotKeys(keys, light);
    if (!(light.innerConeDegrees < light.outerConeDegrees))
      object.fail("innerConeDegrees", "is not below outerConeDegrees",
                  fmt::format("below {:g}", light.outerConeDegrees), fmt::format("{:g}", light.innerConeDegrees));
  }
  object.finish();
  return light;
}

void readName(StrictObject& top, const SceneDescription& scene) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; };
  if (scene.name.empty() || scene.name.size() > 100 || !std::all_of(scene.name.begin(), scene.name.end(), allowed))
    top.fail("name", "is not a short name", "1 to 100 letters, digits and '-'", fmt::format("'{}'", scene.name));
}

void readResolution(StrictObject& top, SceneDescription& scene) {
  const json& resolution = top.at("resolution");
  if (!resolution.is_array() || resolution.size() != 2 || !resolution[0].is_number_unsigned() ||
      !resolution[1].is_number_unsigned() || resolution[0] < 1 || resolution[1] < 1 ||
      resolution[0] > pack::kMaxResolution || resolution[1] > pack::kMaxResolution)
    top.fail("resolution", "is not an image size", fmt::format("[width, height], each 1 to {}", pack::kMaxResolution));
  scene.width = resolution[0].get<std::uint32_t>();
  scene.height = resolution[1].get<std::uint32_t>();
}

void readLights(StrictObject& top, SceneDescription& scene) {
  if (!top.has("lights")) return;
  const std::string expected = fmt::format("a list of at most {} lights", pack::kMaxLights);
  const std::size_t count = top.listSize("lights", expected);
  if (count > pack::kMaxLights) top.fail("lights", "has too many elements", expected, fmt::format("{}", count));
  for (std::size_t i = 0; i < count; ++i) scene.lights.push_back(readLight(top.element("lights", i)));
}

void readMaterials(StrictObject& top, SceneDescription& scene) {
  StrictObject materials = top.object("materials");
  for (const auto& item : top.at("materials").items())
    scene.materials.push_back(readMaterial(item.key(), materials.object(item.key().c_str()), scene));
  if (scene.materials.size() > pack::kMaxMaterials)
    top.fail("materials", "has too many elements", fmt::format("at most {}", pack::kMaxMaterials),
             fmt::format("{}", scene.materials.size()));
}

void readMeshes(StrictObject& top, SceneDescription& scene) {
  if (top.has("imports"))
    for (std::size_t i = 0, count = top.listSize("imports", "a list of files"); i < count; ++i)
      scene.imports.push_back(readImport(top.element("imports", i), scene));
  if (!top.has("meshes") && !scene.imports.empty()) return;
  const std::size_t count = top.listSize("meshes", "a list of meshes");
  if (count == 0 && scene.imports.empty()) top.fail("meshes", "is empty", "one mesh or more, or imports");
  std::set<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    const StrictObject mesh = top.element("meshes", i);
    scene.meshes.push_back(readMesh(mesh, scene));
    const std::string& name = scene.meshes.back().name;
    if (!names.insert(name).second) mesh.fail("name", "occurs twice", "unique names", fmt::format("'{}'", name));
  }
}

}  // namespace

SceneDescription readSceneFile(const std::filesystem::path& path) {
  SceneDescription scene;
  scene.file = path;
  const json document = readJsonFile(path, "the schema of bake/SCENE.md");
  StrictObject top(document, path.string(), "", &scene.deprecations);
  top.integer("malus", 1, 1);
  visitSceneKeys(KeyReader(top), scene);
  readName(top, scene);
  if (top.has("origin")) scene.origin = top.vector("origin", -kMaxSceneLength, kMaxSceneLength);
  readCamera(top.object("camera"), scene);
  readResolution(top, scene);
  if (top.has("environment")) readEnvironment(top.object("environment"), scene);
  readLights(top, scene);
  readMaterials(top, scene);
  readMeshes(top, scene);
  top.finish();
  return scene;
}

}  // namespace malus::bake
