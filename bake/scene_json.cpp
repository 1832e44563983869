#include "bake/scene_json.h"

#include <fmt/format.h>

namespace malus::bake {
using nlohmann::json;

namespace {

json vectorJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

json materialJson(const pack::Material& m) {
  json highlight;
  if (m.highlightStrength > 0) highlight = {{"strength", m.highlightStrength}, {"exponent", m.highlightExponent}};
  json result = {{"name", m.name},
                 {"type", pack::materialKindName(m.kind)},
                 {"eta", vectorJson(m.eta)},
                 {"k", vectorJson(m.k)},
                 {"outsideEta", m.outsideEta},
                 {"albedo", vectorJson(m.albedo)},
                 {"radiance", vectorJson(m.radiance)},
                 {"highlight", highlight}};
  if (m.isPlain()) return result;
  const auto map = [](std::int32_t index) { return index < 0 ? json() : json(index); };
  result["absorption"] = vectorJson(m.absorption);
  result["outsideAbsorption"] = vectorJson(m.outsideAbsorption);
  result["coating"] = {{"eta", vectorJson(m.coating.eta)}, {"thicknessNm", m.coating.thicknessNm}};
  result["roughness"] = m.roughness;
  result["axis"] = vectorJson(m.axis);
  result["polarization"] = m.polarization;
  result["along"] = vectorJson(m.transmittanceParallel);
  result["across"] = vectorJson(m.transmittanceCrossed);
  result["retardanceDegrees"] = vectorJson(m.retardanceDegrees);
  result["maps"] = {{"albedo", map(m.maps.albedo)},        {"eta", map(m.maps.eta)},    {"k", map(m.maps.k)},
                    {"origin", vectorJson(m.maps.origin)}, {"u", vectorJson(m.maps.u)}, {"v", vectorJson(m.maps.v)}};
  return result;
}

}  // namespace

json provenanceJson(const pack::Scene& scene) {
  constexpr int kMaxNesting = 32;
  json provenance = json::parse(
      scene.provenance, [](int depth, json::parse_event_t, const json&) { return depth <= kMaxNesting; }, false);
  return provenance.is_discarded() ? json() : provenance;
}

std::string meshFile(std::size_t index) { return fmt::format("meshes/{:03}.ply", index); }
std::string mapFile(std::size_t index) { return fmt::format("meshes/{:03}.map.json", index); }
std::string textureFile(std::size_t index) { return fmt::format("textures/{:03}.exr", index); }

json sceneJson(const pack::Pack& pack) {
  const pack::Scene& scene = pack.scene;
  json meshes = json::array(), materials = json::array(), lights = json::array();
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const pack::Mesh& mesh = scene.meshes[i];
    meshes.push_back({{"name", mesh.name},
                      {"file", meshFile(i)},
                      {"material", scene.materials[mesh.material].name},
                      {"sheet", mesh.sheet},
                      {"vertices", mesh.positions.size()},
                      {"triangles", mesh.triangles.size()}});
    if (pack.hasSourceMap()) meshes.back()["map"] = mapFile(i);
  }
  for (const pack::Material& m : scene.materials) materials.push_back(materialJson(m));
  for (const pack::PointLight& light : scene.lights)
    lights.push_back(
        {{"type", "point"}, {"position", vectorJson(light.position)}, {"intensity", vectorJson(light.intensity)}});

  json textures = json::array();
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    textures.push_back({{"name", scene.textures[i].name}, {"file", textureFile(i)}});

  const pack::Environment& e = scene.environment;
  json environment = {{"diffuseFill", e.ambientIrradiance}, {"irradiance", json::array()}};
  for (const glm::dvec3& c : e.irradiance) environment["irradiance"].push_back(vectorJson(c));
  if (e.hasSun()) environment["sky"] = {{"sun", vectorJson(e.sun)}, {"maxDegree", e.skyDegree}};
  if (e.size == 0) {
    environment["radiance"] = vectorJson(e.radiance);
  } else {
    environment["image"] = kEnvironmentFile;
    environment["size"] = e.size;
  }

  const pack::Camera& c = scene.camera;
  return {{"name", scene.name},
          {"title", scene.title},
          {"packHash", fmt::format("{:016x}", pack.hash)},
          {"origin", vectorJson(scene.origin)},
          {"resolution", {scene.width, scene.height}},
          {"depth", scene.depth},
          {"exposureEv", scene.exposureEv},
          {"camera",
           {{"position", vectorJson(c.position)},
            {"right", vectorJson(c.right)},
            {"up", vectorJson(c.up)},
            {"forward", vectorJson(c.forward)},
            {"verticalFovDegrees", c.verticalFovDegrees},
            {"mediumEta", c.mediumEta}}},
          {"environment", environment},
          {"lights", lights},
          {"materials", materials},
          {"textures", textures},
          {"meshes", meshes}};
}

}  // namespace malus::bake
