#include "bake/effects/effects.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "bake/effects/mutual_visibility.h"
#include "meshprep/base/error.h"

namespace malus::bake {
using pack::Effect;
using pack::Material;
using pack::MaterialKind;

namespace {

bool positive(const glm::dvec3& v) { return v.x > 0 || v.y > 0 || v.z > 0; }

// Traits of the kind, for namesWhere.
bool isInterface(const Material& m) { return pack::isInterface(m.kind); }
bool isPolarizingElement(const Material& m) { return pack::isPolarizingElement(m.kind); }
bool isDielectric(const Material& m) { return pack::isDielectric(m.kind); }
bool isConductor(const Material& m) { return pack::isConductor(m.kind); }
bool isClear(const Material& m) { return pack::isClear(m.kind); }

bool isCoated(const Material& m) { return m.coating.thicknessNm > 0; }

bool absorbs(const Material& m) { return positive(m.absorption) || positive(m.outsideAbsorption); }

// Smallest index that a dielectric has anywhere.
double leastEta(const pack::Scene& scene, const Material& m) {
  double least = std::min({m.eta.x, m.eta.y, m.eta.z});
  if (m.maps.eta >= 0)
    for (const glm::vec3& t : scene.textures[static_cast<std::size_t>(m.maps.eta)].texels)
      least = std::min(least, static_cast<double>(t.y));
  return least;
}

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
  ImageRequest request;
  request.depth = scene.depth;
  return findEffects(scene, request);
}

std::vector<Effect> findEffects(const pack::Scene& scene, const ImageRequest& request) {
  const std::uint32_t depth = request.depth;
  const auto& filter = request.analyser;
  const bool linearFilter = filter[1] != 0 || filter[2] != 0, circularFilter = filter[3] != 0;
  std::vector<Effect> effects;
  const auto add = [&](const char* name, bool on, std::string reason) {
    effects.push_back({name, on, std::move(reason)});
  };
  const auto addFor = [&](const char* name, const std::string& materials, const char* noun) {
    add(name, !materials.empty(),
        materials.empty() ? fmt::format("no {}", noun)
                          : fmt::format("{}: {}; gone without {}", noun, materials,
                                        materials.find(',') == std::string::npos ? "it" : "them"));
    return !materials.empty();
  };
  const bool deep = depth >= 1;

  const bool diffuse = addFor("diffuse", namesWhere(scene, [](const Material& m) { return positive(m.albedo); }),
                              "material with an albedo");
  addFor("textures", namesWhere(scene, [](const Material& m) { return m.maps.any(); }), "textured material");
  addFor("dielectric", namesWhere(scene, isDielectric), "dielectric interface");
  const bool conductor = addFor("conductor", namesWhere(scene, isConductor), "metal");
  addFor("transmission", namesWhere(scene, isClear), "clear glass");
  addFor("absorption", namesWhere(scene, absorbs), "material with an absorbing medium");
  const bool coated = addFor("coatings", namesWhere(scene, isCoated), "material with a thin film");
  addFor("polarizing-sheets", namesWhere(scene, isPolarizingElement), "polarizer or wave plate");
  const bool plates = !namesWhere(scene, [](const Material& m) {
                         return isPolarizingElement(m) && m.retardanceDegrees != glm::dvec3(0.0);
                       }).empty();
  const std::string rough = namesWhere(scene, [](const Material& m) { return m.roughness > 0; });
  if (deep)
    addFor("rough-reflection", rough, "rough surface");
  else
    add("rough-reflection", false, "depth 0 reflects nothing");
  const std::string bent = namesWhere(scene, [&](const Material& m) {
    if (pack::hasInside(m.kind)) return m.eta.y != m.outsideEta;
    if (!isDielectric(m)) return false;
    return m.outsideEta > leastEta(scene, m);
  });
  const bool tir = deep && !bent.empty();
  add("tir", tir,
      tir ? fmt::format("light on the denser side can be totally reflected: {}; gone at depth 0", bent)
          : "no surface that light meets from its denser side");

  const std::string interfaces = namesWhere(scene, isInterface);
  const bool leaving =
      diffuse && !namesWhere(scene, [](const Material& m) { return isInterface(m) && positive(m.albedo); }).empty();
  // Diattenuators on one path: the filter, interactions, light that leaves a painted surface. Interfaces that cannot
  // see each other stand on no path together.
  const bool several = !interfaces.empty() && interfacesMutuallyVisible(scene);
  const std::uint32_t interactions = interfaces.empty() ? 0 : several ? depth : std::min(depth, 1u);
  // Sources that are polarized themselves end any path.
  const std::string displays = namesWhere(
      scene, [](const Material& m) { return pack::isEmitter(m.kind) && m.polarization > 0 && positive(m.radiance); });
  const bool sky = scene.environment.size > 0 || positive(scene.environment.radiance);
  const bool polarizedSky = scene.environment.skyDegree > 0 && sky, sources = polarizedSky || !displays.empty();
  const std::uint32_t chain = interactions + (sources || (leaving && (several || interactions == 0)) ? 1u : 0u);
  const bool any = interactions > 0 || leaving || sources;
  bool linear = true;
  std::string why;
  if (request.linearStokes && any)
    why = "S1 and S2 are asked for";
  else if (chain >= 2)
    why = sources
              ? fmt::format("polarized light ({}{}{}) meets {}; gone at depth 0", polarizedSky ? "the sky" : "",
                            polarizedSky && !displays.empty() ? ", " : "", displays, interfaces)
              : fmt::format("two diattenuating surfaces can follow each other within depth {}: {}; gone at depth {}",
                            depth, interfaces, leaving ? 0 : 1);
  else if (linearFilter && any)
    why = fmt::format("a linear polarizer stands before the camera and {} polarize; gone without the filter",
                      interfaces.empty() ? "sources" : interfaces);
  else
    linear = false;
  add("linear-polarization", linear,
      linear ? why
             : (interfaces.empty() || depth == 0 || several
                    ? "no path has two diattenuating surfaces"
                    : fmt::format("no path has two diattenuating surfaces: {} cannot see each other", interfaces)));
  // Circular light: made by a phase shifter (metal, total reflection) behind a diattenuator. It counts where two
  // shifters stand strictly between two diattenuators, the first of which may be the filter and the last light that
  // leaves a painted surface; where the filter passes one handedness, or S3 is asked for, one shifter is enough.
  std::vector<const char*> names;
  if (conductor) names.push_back("metal");
  if (tir) names.push_back("total reflection");
  if (plates) names.push_back("wave plates");
  if (coated) names.push_back("thin films");
  const bool shifters = !names.empty() && deep;
  const std::string shifterNames = fmt::format("{}", fmt::join(names, ", "));
  const std::uint32_t between = chain + (linearFilter ? 1u : 0u);
  bool circular = true;
  if (shifters && (request.circularStokes || circularFilter) && chain >= 2)
    why = request.circularStokes ? fmt::format("S3 is asked for, and {} makes it", shifterNames)
                                 : fmt::format("the filter passes one handedness, which {} makes", shifterNames);
  else if (shifters && between >= 4)
    why = fmt::format("two phase shifters ({}) can stand between two diattenuators within depth {}; gone at depth {}",
                      shifterNames, depth, depth - (between - 3));
  else
    circular = false;
  add("circular-polarization", circular, circular ? why : "no path has two phase shifters between two diattenuators");

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
         namesWhere(scene, [](const Material& m) { return pack::isEmitter(m.kind) && positive(m.radiance); }),
         "emitter");
  add("polarized-emitters", !displays.empty(),
      displays.empty() ? "no polarized emitter" : fmt::format("{}; gone with unpolarized light", displays));
  add("environment", sky,
      sky ? (scene.environment.size > 0 ? "a picture surrounds the scene" : "a constant radiance surrounds the scene")
          : "the surroundings are black");
  add("polarized-sky", polarizedSky,
      polarizedSky
          ? fmt::format("Rayleigh's sky, polarized up to {:g}; gone with a maxDegree of 0", scene.environment.skyDegree)
          : "the surroundings are unpolarized");
  add("filter", linearFilter || circularFilter,
      linearFilter || circularFilter ? "a filter stands in front of the camera"
                                     : "set when a filter is put in front of the camera");
  return effects;
}

bool isOn(const std::vector<Effect>& effects, std::string_view name) {
  return std::any_of(effects.begin(), effects.end(), [&](const Effect& e) { return e.name == name && e.on; });
}

std::vector<std::string> effectNames() {
  std::vector<std::string> names;
  for (const Effect& e : findEffects(pack::Scene{})) names.push_back(e.name);
  return names;
}

pack::Scene withoutEffects(pack::Scene scene, const std::vector<std::string>& off) {
  const std::vector<std::string> known = effectNames();
  for (const std::string& name : off) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error("--effects", fmt::format("unknown effect '{}'", name), fmt::format("{}", fmt::join(known, ", ")));
    if (name == "tir") throw Error("--effects", "'tir' cannot be left out alone", "dielectric or transmission");
  }
  const auto isOff = [&](const char* name) { return std::find(off.begin(), off.end(), name) != off.end(); };
  for (Material& m : scene.materials) {
    if (isOff("diffuse")) m.albedo = glm::dvec3(0.0);
    if (isOff("highlights")) m.highlightStrength = 0;
    if (isOff("emitters")) m.radiance = glm::dvec3(0.0);
    if (isClear(m) && isOff("transmission")) m.kind = MaterialKind::mirrorGlass;
    if ((isDielectric(m) && isOff("dielectric")) || (isConductor(m) && isOff("conductor"))) {
      m.kind = MaterialKind::lambert;
      m.eta = glm::dvec3(1.0);
      m.k = glm::dvec3(0.0);
      m.highlightStrength = 0;
    }
  }
  for (Material& m : scene.materials) {
    if (isOff("textures")) m.maps = {};
    if (isOff("absorption")) m.absorption = m.outsideAbsorption = glm::dvec3(0.0);
    if (isOff("coatings")) m.coating = {};
    if (isOff("rough-reflection")) m.roughness = 0;
    if (isOff("polarized-emitters") && pack::isEmitter(m.kind)) m.polarization = 0;
    if (isOff("polarizing-sheets") && isPolarizingElement(m)) {  // grey ones
      m.transmittanceParallel = m.transmittanceCrossed = (m.transmittanceParallel + m.transmittanceCrossed) * 0.5;
      m.retardanceDegrees = glm::dvec3(0.0);
    }
  }
  if (isOff("textures")) scene.textures.clear();
  if (isOff("point-lights")) scene.lights.clear();
  if (pack::Environment& sky = scene.environment; isOff("polarized-sky")) {
    sky.skyDegree = 0;
    sky.sun = glm::dvec3(0.0);
    if (sky.size == 0) {
      sky.irradiance = {};
      sky.irradiance[0] = sky.radiance * std::numbers::pi;
    }
  }
  if (isOff("environment")) scene.environment = {};
  return scene;
}

}  // namespace malus::bake
