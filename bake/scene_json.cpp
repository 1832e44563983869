#include "bake/scene_json.h"

#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bake/pack/field_io.h"
#include "bake/pack/material_fields.h"
#include "bake/pack/mesh_maps.h"
#include "bake/pack/record_fields.h"

namespace malus::bake {
using nlohmann::json;

namespace {

json vectorJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Writes each field of a record under its name; "coating.eta" into the object "coating".
class JsonWriter {
 public:
  explicit JsonWriter(json& object, pack::FieldFilter filter = {}) : object_(object), filter_(filter) {}

  template <class T>
  void operator()(const pack::Field& field, const T& value) {
    if (!filter_.takes(field)) return;
    json* target = &object_;
    std::string_view name = field.name;
    if (const auto dot = name.find('.'); dot != std::string_view::npos) {
      target = &object_[std::string(name.substr(0, dot))];
      name.remove_prefix(dot + 1);
    }
    (*target)[std::string(name)] = valueJson(field, value);
  }

 private:
  static json valueJson(const pack::Field&, const glm::dvec3& v) { return vectorJson(v); }
  static json valueJson(const pack::Field&, const std::array<glm::dvec3, 9>& list) {
    json result = json::array();
    for (const glm::dvec3& v : list) result.push_back(vectorJson(v));
    return result;
  }
  static json valueJson(const pack::Field&, pack::MaterialKind kind) { return pack::materialKindName(kind); }
  static json valueJson(const pack::Field&, pack::LightKind kind) {
    return pack::kLightKindNames[static_cast<std::size_t>(kind)];
  }
  static json valueJson(const pack::Field&, pack::Wrap wrap) {
    return pack::kWrapNames[static_cast<std::size_t>(wrap)];
  }
  static json valueJson(const pack::Field& field, std::int32_t value) {
    return field.isTexture && value < 0 ? json() : json(value);
  }
  template <class T>
  static json valueJson(const pack::Field&, const T& value) {
    return value;
  }

  json& object_;
  pack::FieldFilter filter_;
};

// The maps that the material has, by name, and their factors.
json meshMapsJson(const pack::MeshMaps& maps) {
  json result;
  pack::visitMeshMaps(
      [&](const pack::MapRule& rule, const pack::MeshMap& map) {
        if (map.isUsed()) pack::visitMeshMap(JsonWriter(result[std::string(rule.name)]), map);
      },
      maps);
  pack::visitMeshMapFactors(JsonWriter(result), maps);
  return result;
}

json environmentJson(const pack::Environment& e) {
  json result;
  pack::visitEnvironment(JsonWriter(result), e);
  if (e.hasSun()) pack::visitSky(JsonWriter(result), e);
  if (e.size == 0) {
    result.erase("size");
  } else {
    result.erase("radiance");
    result["image"] = kEnvironmentFile;
  }
  return result;
}

json meshesJson(const pack::Pack& pack) {
  json meshes = json::array();
  for (std::size_t i = 0; i < pack.scene.meshes.size(); ++i) {
    const pack::Mesh& mesh = pack.scene.meshes[i];
    meshes.push_back({{"name", mesh.name},
                      {"file", meshFile(i)},
                      {"material", pack.scene.materials[mesh.material].name},
                      {"openSurface", mesh.openSurface},
                      {"vertices", mesh.positions.size()},
                      {"triangles", mesh.triangles.size()}});
    if (pack.hasSourceMap()) meshes.back()["map"] = mapFile(i);
  }
  return meshes;
}

}  // namespace

json materialJson(const pack::Material& m) {
  json result;
  pack::visitMaterial(JsonWriter(result, {pack::kMaterials}), m);
  if (m.highlightStrength == 0) result["highlight"] = nullptr;
  if (!m.isPlain()) pack::visitMaterial(JsonWriter(result, {pack::kSurfaces, pack::newestSurfaceVersion()}), m);
  if (m.meshMaps.any()) result["meshMaps"] = meshMapsJson(m.meshMaps);
  return result;
}

json effectsJson(const std::vector<pack::Effect>& effects) {
  json result = json::array();
  for (const pack::Effect& e : effects) pack::visitEffect(JsonWriter(result.emplace_back()), e);
  return result;
}

json provenanceJson(const pack::Scene& scene) {
  constexpr int kMaxNesting = 32;
  json provenance = json::parse(
      scene.provenance, [](int depth, json::parse_event_t, const json&) { return depth <= kMaxNesting; }, false);
  return provenance.is_discarded() ? json() : provenance;
}

std::vector<std::string> bakeWarnings(const pack::Scene& scene) {
  const json provenance = provenanceJson(scene);
  std::vector<std::string> warnings;
  if (!provenance.is_object() || !provenance.contains("warnings")) return warnings;
  for (const json& warning : provenance["warnings"])
    if (warning.is_string()) warnings.push_back(warning.get<std::string>());
  return warnings;
}

std::string meshFile(std::size_t index) { return fmt::format("meshes/{:03}.ply", index); }
std::string mapFile(std::size_t index) { return fmt::format("meshes/{:03}.map.json", index); }
std::string textureFile(std::size_t index) { return fmt::format("textures/{:03}.exr", index); }

json sceneJson(const pack::Pack& pack) {
  const pack::Scene& scene = pack.scene;
  json document, materials = json::array(), lights = json::array(), textures = json::array();
  pack::visitMeta(JsonWriter(document), scene);
  pack::visitWavelengths(JsonWriter(document), scene);
  document.erase("width");
  document.erase("height");
  document["resolution"] = {scene.width, scene.height};
  document["packHash"] = fmt::format("{:016x}", pack.hash);
  pack::visitCamera(JsonWriter(document["camera"], {nullptr, pack::cameraVersion(scene.camera)}), scene.camera);
  document["environment"] = environmentJson(scene.environment);
  for (const pack::LightSource& light : scene.lights) {
    lights.push_back({{"type", "point"}});
    pack::visitLight(JsonWriter(lights.back(), {nullptr, pack::lightsVersion(scene.lights)}), light);
  }
  for (const pack::Material& m : scene.materials) materials.push_back(materialJson(m));
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    textures.push_back({{"file", textureFile(i)}});
    pack::visitTexture(JsonWriter(textures.back()), scene.textures[i]);
  }
  document["lights"] = std::move(lights);
  document["materials"] = std::move(materials);
  document["textures"] = std::move(textures);
  document["meshes"] = meshesJson(pack);
  for (const pack::Instance& instance : scene.instances) {
    json& entry = document["instances"].emplace_back();
    pack::visitInstance(JsonWriter(entry), instance);
    entry["mesh"] = scene.meshes[instance.mesh].name;
  }
  return document;
}

}  // namespace malus::bake
