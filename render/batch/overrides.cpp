#include "render/batch/overrides.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
#include "render/batch/material_keys.h"

namespace malus::render {
using bake::StrictObject;

namespace {

glm::dvec3 readWavelengths(StrictObject& frame, const pack::Scene& scene) {
  return frame.has("wavelengthsNm") ? frame.vector("wavelengthsNm", pack::kMinWavelengthNm, pack::kMaxWavelengthNm)
                                    : scene.wavelengthsNm;
}

// The pack has the optical constants at its wavelengths only: at others the frame must state them.
void requireConstants(StrictObject& frame, const pack::Scene& scene, const std::set<std::string>& stated) {
  std::set<std::uint32_t> used;
  for (const pack::Mesh& mesh : scene.meshes) used.insert(mesh.material);
  for (const std::uint32_t i : used) {
    const pack::Material& m = scene.materials[i];
    if (!pack::hasIndex(m.kind)) continue;
    const bool isMapped = m.maps.eta >= 0 || m.meshMaps.eta.isUsed() || m.meshMaps.reflectance.isUsed();
    if (!isMapped && stated.contains(m.name)) continue;
    frame.fail("wavelengthsNm",
               fmt::format("the pack has the index of material '{}' at {:g}, {:g} and {:g} nm only", m.name,
                           scene.wavelengthsNm.x, scene.wavelengthsNm.y, scene.wavelengthsNm.z),
               isMapped ? "the wavelengths of the pack, because a texture has the index"
                        : fmt::format("'preset' or 'eta' of materials.{} in the same frame", m.name));
  }
}

void readMaterials(StrictObject& frame, const pack::Scene& scene, SceneSurfaces& surfaces) {
  std::set<std::string> stated;  // materials whose index the frame states
  if (frame.has("materials")) {
    StrictObject materials = frame.object("materials");
    for (pack::Material& m : surfaces.materials) {
      if (!materials.has(m.name.c_str())) continue;
      StrictObject object = materials.object(m.name.c_str());
      if (object.has("preset") || object.has("eta")) stated.insert(m.name);
      overrideMaterial(object, surfaces.wavelengthsNm, m);
    }
    materials.finish();
  }
  if (surfaces.wavelengthsNm != scene.wavelengthsNm) requireConstants(frame, scene, stated);
}

// true, false, or a list with one of both per light.
void readLights(StrictObject& frame, SceneSurfaces& surfaces) {
  if (!frame.has("lights")) return;
  const nlohmann::json& value = frame.at("lights");
  const std::size_t count = surfaces.lights.size();
  const std::string expected = fmt::format("true, false, or a list of {} of them, one per light", count);
  if (value.is_boolean()) {
    if (!value.get<bool>()) surfaces.lights.clear();
    return;
  }
  if (!value.is_array() || value.size() != count ||
      !std::all_of(value.begin(), value.end(), [](const auto& v) { return v.is_boolean(); }))
    frame.fail("lights", "does not switch the lights of the pack", expected, value.dump());
  std::vector<pack::LightSource> on;
  for (std::size_t i = 0; i < count; ++i)
    if (value[i].get<bool>()) on.push_back(surfaces.lights[i]);
  surfaces.lights = std::move(on);
}

void readEnvironment(StrictObject& frame, SceneSurfaces& surfaces) {
  if (!frame.has("environment")) return;
  StrictObject environment = frame.object("environment");
  surfaces.environmentRotationDegrees = environment.number("rotationDegrees", -1e6, 1e6, 0);
  environment.finish();
}

}  // namespace

SceneSurfaces readSurfaces(StrictObject& frame, const pack::Scene& scene) {
  SceneSurfaces surfaces{readWavelengths(frame, scene), scene.materials, scene.lights, 0};
  readMaterials(frame, scene, surfaces);
  readLights(frame, surfaces);
  readEnvironment(frame, surfaces);
  return surfaces;
}

}  // namespace malus::render
