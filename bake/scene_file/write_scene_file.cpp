#include "bake/scene_file/write_scene_file.h"

#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "bake/scene_file/scene_keys.h"

namespace malus::bake {

namespace {

using Json = nlohmann::ordered_json;

Json valueJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
template <class T>
Json valueJson(const T& value) {
  return value;
}
template <class T>
Json valueJson(const std::optional<T>& value) {
  return value ? valueJson(*value) : Json();
}

// A visitor of the tables of scene_keys.h with a record and one of defaults: writes required keys, and others that
// differ from their default.
class KeyWriter {
 public:
  explicit KeyWriter(Json& object) : object_(object) {}
  template <class T>
  void operator()(const pack::Field& field, const T& value, const T& fallback) {
    if (field.key == pack::Key::none || (field.key == pack::Key::optional && value == fallback)) return;
    object_[std::string(field.name)] = valueJson(value);
  }

 private:
  Json& object_;
};

std::string fileName(const std::filesystem::path& file, const std::filesystem::path& scene) {
  std::error_code failed;
  const std::filesystem::path target = std::filesystem::absolute(file, failed).lexically_normal(),
                              folder = std::filesystem::absolute(scene, failed).lexically_normal().parent_path();
  const std::filesystem::path relative = target.lexically_relative(folder);
  return (relative.empty() ? target : relative).generic_string();
}

Json cameraJson(const SceneDescription& d, const SceneDescription& defaults) {
  Json camera = Json::object();
  visitCameraKeys(KeyWriter(camera), d, defaults);
  if (d.orthographicHeight > 0) {
    visitOrthographicKeys(KeyWriter(camera), d, defaults);
  } else if (d.intrinsics) {
    const Intrinsics none;
    visitIntrinsicsKeys(KeyWriter(camera["intrinsics"]), *d.intrinsics, none);
  } else {
    visitFovKeys(KeyWriter(camera), d, defaults);
  }
  return camera;
}

Json lightJson(const pack::LightSource& light) {
  const pack::LightSource none{};
  Json object = {{"type", pack::kLightKindNames[static_cast<std::size_t>(light.kind)]}};
  KeyWriter keys(object);
  if (light.kind == pack::LightKind::directional)
    visitDirectionalKeys(keys, light, none);
  else
    visitLightKeys(keys, light, none);
  if (light.kind != pack::LightKind::point) visitDirectionKeys(keys, light, none);
  if (light.kind == pack::LightKind::spot) visitSpotKeys(keys, light, none);
  return object;
}

Json environmentJson(const SceneDescription& d, const SceneDescription& defaults, const std::filesystem::path& path) {
  Json environment;
  if (!d.environmentPreset.empty()) environment["preset"] = d.environmentPreset;
  if (!d.environmentImage.empty()) environment["image"] = fileName(d.environmentImage, path);
  if (environment.empty())
    visitConstantKeys(KeyWriter(environment), d, defaults);
  else
    visitImageKeys(KeyWriter(environment), d, defaults);
  if (d.ambientIrradiance != defaults.ambientIrradiance) environment["ambientIrradiance"] = d.ambientIrradiance;
  if (d.environmentIlluminates) environment["illuminates"] = true;
  return environment;
}

}  // namespace

std::string sceneFileText(const SceneDescription& d, const std::filesystem::path& path) {
  const SceneDescription defaults;
  Json document = {{"malus", 1}};
  visitSceneKeys(KeyWriter(document), d, defaults);
  document["resolution"] = {d.width, d.height};
  document["camera"] = cameraJson(d, defaults);
  document["environment"] = environmentJson(d, defaults, path);
  for (const pack::LightSource& light : d.lights) document["lights"].push_back(lightJson(light));
  document["materials"] = Json::object();
  const prep::Options uncleaned;
  for (const ImportDescription& import : d.imports) {
    Json& object = document["imports"].emplace_back(Json{{"file", fileName(import.file, path)}});
    visitCleaningKeys(KeyWriter(object), import.preparation, uncleaned);
  }
  return document.dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

}  // namespace malus::bake
