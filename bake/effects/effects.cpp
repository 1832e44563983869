#include "bake/effects/effects.h"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

namespace malus::bake {
using pack::Effect;
using pack::Material;
using pack::MaterialKind;

namespace {

bool positive(const glm::dvec3& v) { return v.x > 0 || v.y > 0 || v.z > 0; }

bool isInterface(const Material& m) { return m.kind != MaterialKind::lambert && m.kind != MaterialKind::emitter; }

// Names of the used materials for which a property holds, for people.
std::string namesWhere(const pack::Scene& scene, const std::function<bool(const Material&)>& holds) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const pack::Mesh& mesh : scene.meshes) used[mesh.material] = true;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (used[i] && holds(scene.materials[i])) names.push_back(scene.materials[i].name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<Effect> findEffects(const pack::Scene& scene) {
  std::vector<Effect> effects;
  const auto add = [&](const char* name, bool on, std::string reason) {
    effects.push_back({name, on, std::move(reason)});
  };
  const auto addFor = [&](const char* name, const std::string& materials, const char* noun) {
    add(name, !materials.empty(),
        materials.empty() ? fmt::format("no {}", noun) : fmt::format("{}: {}", noun, materials));
    return !materials.empty();
  };
  const bool deep = scene.depth >= 1;

  const bool diffuse = addFor("diffuse", namesWhere(scene, [](const Material& m) { return positive(m.albedo); }),
                              "material with an albedo");
  add("textures", false, "this version of the pack has none");
  const std::string dielectrics = namesWhere(scene, [](const Material& m) {
    return m.kind == MaterialKind::paint || m.kind == MaterialKind::mirrorGlass || m.kind == MaterialKind::glass;
  });
  addFor("dielectric", dielectrics, "dielectric interface");
  const bool conductor =
      addFor("conductor", namesWhere(scene, [](const Material& m) { return m.kind == MaterialKind::metal; }), "metal");
  const std::string glass = namesWhere(scene, [](const Material& m) { return m.kind == MaterialKind::glass; });
  addFor("transmission", glass, "clear glass");
  add("absorption", false, "all glass of this version is clear");
  const std::string bent = namesWhere(scene, [](const Material& m) {
    if (m.kind == MaterialKind::glass) return m.eta.y != m.outsideEta;
    if (m.kind != MaterialKind::paint && m.kind != MaterialKind::mirrorGlass) return false;
    return m.outsideEta > m.eta.x || m.outsideEta > m.eta.y || m.outsideEta > m.eta.z;
  });
  const bool tir = deep && !bent.empty();
  add("tir", tir,
      tir ? fmt::format("light on the denser side can be totally reflected: {}", bent)
          : "no surface that light meets from its denser side");

  const std::string interfaces = namesWhere(scene, isInterface);
  const bool leaving =
      diffuse && !namesWhere(scene, [](const Material& m) { return isInterface(m) && positive(m.albedo); }).empty();
  const bool linear = !interfaces.empty() && (scene.depth >= 2 || (deep && leaving));
  add("linear-polarization", linear,
      linear
          ? fmt::format("two diattenuating surfaces can follow each other within depth {}: {}", scene.depth, interfaces)
          : "no path has two diattenuating surfaces");
  // Two phase shifters strictly between two diattenuators take four interactions, the last of which may be
  // light that leaves a painted surface.
  const bool circular = (conductor || tir) && scene.depth + (leaving ? 1u : 0u) >= 4;
  add("circular-polarization", circular,
      circular ? fmt::format("two phase shifters ({}) can stand between two diattenuators within depth {}",
                             conductor ? (tir ? "metal, total reflection" : "metal") : "total reflection", scene.depth)
               : "no path has two phase shifters between two diattenuators");

  const bool lights = !scene.lights.empty();
  const bool highlights =
      deep && lights && !namesWhere(scene, [](const Material& m) { return m.highlightStrength > 0; }).empty();
  const bool lit = lights && (diffuse || highlights);
  add("shadows", lit, lit ? "point lights reach diffuse or glossy surfaces" : "nothing is lit by point lights");
  add("point-lights", lit,
      lit      ? fmt::format("{} point lights", scene.lights.size())
      : lights ? "no surface shows them"
               : "no point light");
  add("highlights", highlights,
      highlights ? "glossy materials under point lights" : "no glossy material under a point light");
  addFor("emitters",
         namesWhere(scene, [](const Material& m) { return m.kind == MaterialKind::emitter && positive(m.radiance); }),
         "emitter");
  const bool sky = scene.environment.size > 0 || positive(scene.environment.radiance);
  add("environment", sky,
      sky ? (scene.environment.size > 0 ? "a picture surrounds the scene" : "a constant radiance surrounds the scene")
          : "the surroundings are black");
  add("filter", false, "set when a filter is put in front of the camera");
  return effects;
}

}  // namespace malus::bake
