#include "bake/scene_file/scene_file.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/materials/library.h"
#include "bake/pack/format.h"
#include "bake/scene_file/strict_object.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::bake {
using nlohmann::json;

namespace {

constexpr double kFar = 1e12;    // metres
constexpr double kBright = 1e9;  // radiance, intensity

// More than SCENE.md needs; what is nested deeper would overflow the stack of whoever walks it.
constexpr int kMaxNesting = 32;

json parseJson(const std::filesystem::path& path) {
  const std::string text = readTextFile(path, std::size_t{1} << 26);
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto check = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > kMaxNesting)
      throw Error(path.string(), "is nested too deep", fmt::format("at most {} levels", kMaxNesting));
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw Error(path.string(), fmt::format("key '{}' is there twice in one object", value.get<std::string>()),
                  "each key once");
    return true;
  };
  try {
    return json::parse(text, check);
  } catch (const json::out_of_range& error) {  // a number such as 1e999
    throw Error(path.string(), "holds a number that no double holds", "bake/SCENE.md's schema", error.what());
  } catch (const json::parse_error& error) {
    const auto line =
        1 +
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size())), '\n');
    throw Error(fmt::format("{}:{}", path.string(), line), "is not JSON", "bake/SCENE.md's schema", error.what());
  }
}

void readCamera(StrictObject camera, SceneDescription& scene) {
  scene.cameraPosition = camera.vector("position", -kFar, kFar);
  scene.cameraTarget = camera.vector("target", -kFar, kFar);
  scene.cameraUp = camera.vector("up", -kFar, kFar, {0, 1, 0});
  scene.verticalFovDegrees = camera.number("verticalFovDegrees", 0.01, 170);
  scene.mediumEta = camera.number("mediumEta", pack::kMinEta, pack::kMaxEta, 1);
  camera.finish();
}

// A direction, as a unit vector.
glm::dvec3 direction(StrictObject& object, const char* key) {
  const glm::dvec3 v = object.vector(key, -kFar, kFar);
  const double length = glm::length(v);
  if (!(length > 0)) object.fail(key, "is no direction", "a vector other than 0");
  return v / length;
}

void readEnvironment(StrictObject environment, SceneDescription& scene) {
  const bool constant = environment.has("radiance"), image = environment.has("image");
  if (constant == image)
    environment.fail("radiance", "and image exclude each other", "one of the two", constant ? "both" : "neither");
  if (constant) scene.environmentRadiance = environment.vector("radiance", 0, kBright);
  if (image) {
    scene.environmentImage = scene.file.parent_path() / environment.text("image");
    scene.environmentScale = environment.number("scale", 0, kBright, 1);
    scene.environmentRotationDegrees = environment.number("rotationDegrees", -360, 360, 0);
  }
  if (environment.has("sky")) {
    StrictObject sky = environment.object("sky");
    scene.sun = direction(sky, "sun");
    scene.skyDegree = sky.number("maxDegree", 0, 1, 0.8);
    sky.finish();
  }
  scene.ambientIrradiance = environment.number("diffuseFill", 0, 1000, 0);
  environment.finish();
}

pack::MaterialKind kindNamed(StrictObject& material) {
  const std::string type = material.text("type");
  if (const auto kind = pack::findMaterialKind(type)) return *kind;
  std::vector<std::string_view> names;
  for (const pack::MaterialKindInfo& info : pack::kMaterialKinds) names.push_back(info.name);
  material.fail("type", "unknown type of material", fmt::format("{}", fmt::join(names, ", ")),
                fmt::format("'{}'", type));
}

// The complex index: a preset's, or eta and k.
void readIndex(StrictObject& material, pack::Material& result, bool dielectric) {
  const bool preset = material.has("preset"), eta = material.has("eta");
  if (preset && (eta || material.has("k"))) material.fail("preset", "and eta, k exclude each other", "one of the two");
  if (preset) {
    const std::string name = material.text("preset");
    const OpticalConstants* found = findMaterial(name);
    if (!found) {
      const std::string near = nearestName(name, materialNames());
      material.fail("preset", fmt::format("unknown material '{}'", name),
                    near.empty() ? "a name from 'malus --list-materials'"
                                 : fmt::format("'{}' or another from 'malus --list-materials'", near));
    }
    result.eta = found->eta;
    result.k = found->k;
  } else {
    if (!dielectric || eta) result.eta = material.numberOrVector("eta", 0, pack::kMaxEta);
    result.k = material.numberOrVector("k", 0, pack::kMaxEta, glm::dvec3(0.0));
  }
  for (int c = 0; c < 3; ++c) {
    if (dielectric && result.k[c] != 0) material.fail("k", "of a dielectric", "0", fmt::format("{}", result.k[c]));
    if (result.eta[c] < pack::kMinEta && (dielectric || result.k[c] < pack::kMinEta))
      material.fail("eta", "is too small", fmt::format("{:g} or more", pack::kMinEta),
                    fmt::format("{}", result.eta[c]));
  }
}

// Index of the picture among the scene's textures.
std::int32_t readMap(StrictObject map, SceneDescription& scene, TextureDescription texture) {
  texture.file = scene.file.parent_path() / map.text("image");
  texture.scale = map.number("scale", -1e6, 1e6, 1);
  texture.offset = map.number("offset", -1e6, 1e6, 0);
  map.finish();
  const auto found = std::find(scene.textures.begin(), scene.textures.end(), texture);
  const auto index = static_cast<std::int32_t>(found - scene.textures.begin());
  if (found == scene.textures.end()) scene.textures.push_back(std::move(texture));
  if (scene.textures.size() > pack::kMaxTextures)
    map.fail("", "too many pictures", fmt::format("at most {}", pack::kMaxTextures));
  return index;
}

void readMaps(StrictObject& material, pack::Material& result, SceneDescription& scene) {
  const bool metal = pack::isConductor(result.kind);
  if (pack::canBeDiffuse(result.kind) && material.has("albedoMap"))
    result.maps.albedo = readMap(material.object("albedoMap"), scene, {{}, 1, 0, 0, 1, false});
  if (pack::canHaveIndexMap(result.kind)) {
    if (material.has("etaMap"))
      result.maps.eta =
          readMap(material.object("etaMap"), scene, {{}, 1, 0, metal ? 0 : pack::kMinEta, pack::kMaxEta, !metal});
    if (metal && material.has("kMap"))
      result.maps.k = readMap(material.object("kMap"), scene, {{}, 1, 0, pack::kMinEta, pack::kMaxEta, false});
    if (metal && (result.maps.eta >= 0) != (result.maps.k >= 0))
      material.fail("etaMap", "and kMap belong together", "both", "one");
  }
  if (!result.maps.any()) return;
  StrictObject projection = material.object("projection");
  result.maps.origin = projection.vector("origin", -kFar, kFar, {0, 0, 0});
  result.maps.u = projection.vector("u", -kFar, kFar);
  result.maps.v = projection.vector("v", -kFar, kFar);
  projection.finish();
}

// What few materials have.
void readExtras(StrictObject& material, pack::Material& result, SceneDescription& scene) {
  using Kind = pack::MaterialKind;
  const Kind kind = result.kind;
  result.outsideAbsorption = material.numberOrVector("outsideAbsorption", 0, pack::kMaxAbsorption, glm::dvec3(0.0));
  if (pack::hasInside(kind))
    result.absorption = material.numberOrVector("absorption", 0, pack::kMaxAbsorption, glm::dvec3(0.0));
  if (pack::canBeCoated(kind) && material.has("coating")) {
    StrictObject coating = material.object("coating");
    result.coating.eta = coating.numberOrVector("eta", pack::kMinEta, pack::kMaxEta);
    result.coating.thicknessNm = coating.number("thicknessNm", 0, pack::kMaxThicknessNm);
    coating.finish();
  }
  if (pack::canBeRough(kind)) result.roughness = material.number("roughness", 0, 1, 0);
  if (pack::isEmitter(kind) && material.has("polarization")) {
    StrictObject polarization = material.object("polarization");
    result.axis = direction(polarization, "axis");
    result.polarization = polarization.number("degree", 0, 1, 1);
    polarization.finish();
  }
  if (kind == Kind::polarizer) {
    result.axis = direction(material, "axis");
    result.transmittanceParallel = material.numberOrVector("along", 0, 1, glm::dvec3(1.0));
    result.transmittanceCrossed = material.numberOrVector("across", 0, 1, glm::dvec3(0.0));
  }
  if (kind == Kind::wavePlate) {
    result.axis = direction(material, "axis");
    result.retardanceDegrees = material.numberOrVector("retardanceDegrees", -pack::kMaxRetardanceDegrees,
                                                       pack::kMaxRetardanceDegrees, glm::dvec3(90.0));
    result.transmittanceParallel = result.transmittanceCrossed =
        material.numberOrVector("transmittance", 0, 1, glm::dvec3(1.0));
  }
  readMaps(material, result, scene);
}

pack::Material readMaterial(const std::string& name, StrictObject material, SceneDescription& scene) {
  using Kind = pack::MaterialKind;
  pack::Material result;
  result.name = name;
  result.kind = kindNamed(material);
  const Kind kind = result.kind;
  if (pack::hasIndex(kind)) {
    // A mirror with an index map has its index there.
    const bool optional = kind == Kind::paint || (kind == Kind::mirrorGlass && material.has("etaMap"));
    if (optional) result.eta = glm::dvec3(1.5);
    readIndex(material, result, pack::isDielectric(kind));
    if (!optional && pack::isDielectric(kind) && !material.has("preset") && !material.has("eta"))
      material.fail("preset", "is missing", "a preset, or eta");
  }
  result.outsideEta = material.number("outsideEta", pack::kMinEta, pack::kMaxEta, 1);
  readExtras(material, result, scene);
  const bool mapped = result.maps.albedo >= 0;
  if ((kind == Kind::lambert || kind == Kind::paint) && !mapped)
    result.albedo = material.numberOrVector("albedo", 0, 1);
  else if (mapped)
    result.albedo = material.numberOrVector("albedo", 0, 1, glm::dvec3(1.0));
  if (pack::isConductor(kind) && !mapped) result.albedo = material.numberOrVector("albedo", 0, 1, glm::dvec3(0.0));
  if (pack::isEmitter(kind)) result.radiance = material.vector("radiance", 0, kBright);
  if (pack::hasIndex(kind) && material.has("highlight")) {
    StrictObject highlight = material.object("highlight");
    result.highlightExponent = highlight.integer("exponent", 1, 4095);
    result.highlightStrength = highlight.number("strength", 0, 1e6, 1);
    highlight.finish();
  }
  material.finish();
  return result;
}

Transform readTransform(StrictObject transform) {
  Transform result;
  result.scale = transform.numberOrVector("scale", -1e9, 1e9, glm::dvec3(1.0));
  for (int i = 0; i < 3; ++i)
    if (result.scale[i] == 0) transform.fail("scale", "flattens the mesh", "a number other than 0", "0");
  result.rotateDegrees = transform.vector("rotateDegrees", -3600, 3600, glm::dvec3(0.0));
  result.translate = transform.vector("translate", -kFar, kFar, glm::dvec3(0.0));
  transform.finish();
  return result;
}

// How a mesh, or every part of an import, is cleaned.
void readCleaning(StrictObject& object, prep::Options& options) {
  options.flat = object.flag("flat", false);
  options.creaseDegrees = object.number("creaseDegrees", 0, 180, 40);
  options.steps.weldTolerance = object.number("weldTolerance", 0, kFar, 0);
  options.weldRelative = object.number("weldRelative", 0, 1, 0);
  options.steps.dropOpposite = object.flag("dropOpposite", false);
  options.steps.fillHoles = object.integer("fillHoles", 0, 1'000'000, 0);
  if (!object.has("skip")) return;
  const json& skip = object.at("skip");
  if (!skip.is_array()) object.fail("skip", "is no list", "a list of steps");
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
  object.fail("normals", "unknown kind of normals", "'crease', 'smoothing' or 'authored'", fmt::format("'{}'", name));
}

// A name of one of the scene's materials.
void requireMaterial(const StrictObject& object, const char* key, const std::string& name,
                     const SceneDescription& scene) {
  std::vector<std::string> names;
  for (const pack::Material& m : scene.materials) names.push_back(m.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string near = nearestName(name, names);
  object.fail(key, fmt::format("unknown material '{}'", name),
              near.empty() ? "a name under materials" : fmt::format("'{}' or another under materials", near));
}

MeshDescription readMesh(StrictObject mesh, const SceneDescription& scene, const std::string& where) {
  MeshDescription result;
  result.name = mesh.text("name");
  result.file = scene.file.parent_path() / mesh.text("file");
  result.material = mesh.text("material");
  requireMaterial(mesh, "material", result.material, scene);
  readCleaning(mesh, result.preparation);
  result.preparation.normals = readNormals(mesh).value_or(prep::Normals::crease);
  result.preparation.sheet = mesh.flag("sheet", false);
  result.preparation.asIs = mesh.flag("asIs", false);
  if (mesh.has("instances")) {
    const json& instances = mesh.at("instances");
    if (!instances.is_array() || instances.empty()) mesh.fail("instances", "is no list", "a list of transforms");
    for (std::size_t i = 0; i < instances.size(); ++i)
      result.instances.push_back(readTransform({instances[i], where, mesh.pathOf(fmt::format("instances[{}]", i))}));
  } else {
    result.instances.emplace_back();
  }
  mesh.finish();
  return result;
}

ImportDescription readImport(StrictObject object, const SceneDescription& scene) {
  ImportDescription result;
  result.file = scene.file.parent_path() / object.text("file");
  if (object.has("materials")) {
    StrictObject materials = object.object("materials");
    for (const auto& item : object.at("materials").items()) {
      const char* name = item.key().c_str();
      result.materials[name] = materials.text(name);
      requireMaterial(materials, name, result.materials[name], scene);
    }
  }
  if (object.has("transform")) result.transform = readTransform(object.object("transform"));
  readCleaning(object, result.preparation);
  result.normals = readNormals(object);
  if (object.has("sheets")) {
    const json& sheets = object.at("sheets");
    const auto isText = [](const json& sheet) { return sheet.is_string(); };
    if (!sheets.is_array() || !std::all_of(sheets.begin(), sheets.end(), isText))
      object.fail("sheets", "is no list of names", "a list of strings");
    result.sheets = sheets.get<std::vector<std::string>>();
  }
  object.finish();
  return result;
}

}  // namespace

SceneDescription readSceneFile(const std::filesystem::path& path) {
  SceneDescription scene;
  scene.file = path;
  const std::string where = path.string();
  const json document = parseJson(path);
  StrictObject top(document, where, "");

  top.integer("malus", 1, 1);
  scene.name = top.text("name");
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; };
  if (scene.name.empty() || scene.name.size() > 100 || !std::all_of(scene.name.begin(), scene.name.end(), allowed))
    top.fail("name", "is no short name", "1 to 100 letters, digits and '-'", fmt::format("'{}'", scene.name));
  scene.title = top.text("title", "");
  if (top.has("origin")) scene.origin = top.vector("origin", -kFar, kFar);
  readCamera(top.object("camera"), scene);
  const json& resolution = top.at("resolution");
  if (!resolution.is_array() || resolution.size() != 2 || !resolution[0].is_number_unsigned() ||
      !resolution[1].is_number_unsigned() || resolution[0] < 1 || resolution[1] < 1 ||
      resolution[0] > pack::kMaxResolution || resolution[1] > pack::kMaxResolution)
    top.fail("resolution", "is no picture size", fmt::format("[width, height], each 1 to {}", pack::kMaxResolution));
  scene.width = resolution[0].get<std::uint32_t>();
  scene.height = resolution[1].get<std::uint32_t>();
  scene.depth = top.integer("depth", 0, pack::kMaxDepth);
  scene.exposureEv = top.number("exposureEv", -100, 100, 0);
  if (top.has("environment")) readEnvironment(top.object("environment"), scene);

  if (top.has("lights")) {
    const json& lights = top.at("lights");
    if (!lights.is_array() || lights.size() > pack::kMaxLights)
      top.fail("lights", "is no list", fmt::format("a list of at most {} lights", pack::kMaxLights));
    for (std::size_t i = 0; i < lights.size(); ++i) {
      StrictObject light(lights[i], where, fmt::format("lights[{}]", i));
      if (const std::string type = light.text("type"); type != "point")
        light.fail("type", "unknown type of light", "'point'", fmt::format("'{}'", type));
      pack::PointLight point;
      point.position = light.vector("position", -kFar, kFar);
      point.intensity = light.vector("intensity", 0, kBright);
      light.finish();
      scene.lights.push_back(point);
    }
  }

  StrictObject materials = top.object("materials");
  for (const auto& item : top.at("materials").items())
    scene.materials.push_back(
        readMaterial(item.key(), {item.value(), where, fmt::format("materials.{}", item.key())}, scene));
  if (scene.materials.size() > pack::kMaxMaterials)
    top.fail("materials", "too many", fmt::format("at most {}", pack::kMaxMaterials));

  if (top.has("imports")) {
    const json& imports = top.at("imports");
    if (!imports.is_array()) top.fail("imports", "is no list", "a list of files");
    for (std::size_t i = 0; i < imports.size(); ++i)
      scene.imports.push_back(readImport({imports[i], where, fmt::format("imports[{}]", i)}, scene));
  }

  static const json kNone = json::array();
  const json& meshes = !scene.imports.empty() && !top.has("meshes") ? kNone : top.at("meshes");
  if (!meshes.is_array() || (meshes.empty() && scene.imports.empty()))
    top.fail("meshes", "is no list", "a list of one mesh or more, or imports");
  std::set<std::string> names;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    StrictObject mesh(meshes[i], where, fmt::format("meshes[{}]", i));
    scene.meshes.push_back(readMesh(mesh, scene, where));
    if (!names.insert(scene.meshes.back().name).second)
      mesh.fail("name", "is there twice", "unique names", fmt::format("'{}'", scene.meshes.back().name));
  }
  top.finish();
  return scene;
}

}  // namespace malus::bake
