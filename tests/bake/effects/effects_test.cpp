// Which effects a scene calls for. When polarization may be left out is the theorem of shaders/optics: at
// most one diattenuating element between the camera and every contribution.
#include "bake/effects/effects.h"

#include <cmath>
#include <map>
#include <set>

#include "bake/effects/deepest_bounce.h"
#include "bake/effects/polarization_bound.h"
#include "bake/effects/rules.h"

#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using pack::Material;
using pack::MaterialKind;

Material material(MaterialKind kind, double albedo = 0) {
  Material m;
  m.name = std::string(pack::materialKindName(kind));
  m.kind = kind;
  if (kind == MaterialKind::metal) {
    m.eta = glm::dvec3(0.2);
    m.k = glm::dvec3(3);
  } else if (kind != MaterialKind::lambert && kind != MaterialKind::emitter) {
    m.eta = glm::dvec3(1.5);
  }
  m.albedo = glm::dvec3(albedo);
  if (kind == MaterialKind::emitter) m.radiance = glm::dvec3(1);
  return m;
}

// Each material on one mesh.
pack::Scene sceneOf(std::vector<Material> materials, std::uint32_t depth) {
  pack::Scene scene;
  scene.depth = depth;
  scene.materials = std::move(materials);
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    pack::Mesh mesh;
    mesh.material = i;
    scene.meshes.push_back(mesh);
  }
  return scene;
}

std::map<std::string, bool> effectsOf(const pack::Scene& scene) {
  std::map<std::string, bool> on;
  for (const pack::Effect& e : findEffects(scene)) {
    EXPECT_FALSE(e.reason.empty()) << e.name;
    on[e.name] = e.on;
  }
  return on;
}

TEST(Effects, AllOfThemInOrder) {
  std::vector<std::string> names;
  for (const pack::Effect& e : findEffects(sceneOf({}, 4))) {
    names.push_back(e.name);
    EXPECT_FALSE(e.on) << e.name;  // nothing is there
  }
  EXPECT_EQ(names, effectNames());
  EXPECT_EQ(names, (std::vector<std::string>{"metal",
                                             "glass",
                                             "polarizing-elements",
                                             "point-lights",
                                             "shadows",
                                             "highlights",
                                             "textures",
                                             "absorption",
                                             "coatings",
                                             "roughness",
                                             "sky",
                                             "polarized-emitters",
                                             "diffuse",
                                             "dielectric",
                                             "tir",
                                             "linear-polarization",
                                             "circular-polarization",
                                             "emitters",
                                             "environment",
                                             "filter"}));
}

// Each row of shaders/effects.def has one rule, in order; a listed one has a description.
TEST(Effects, EveryRowHasItsRule) {
  ASSERT_EQ(effectRules().size(), shaders::kEffects.size());
  for (std::size_t i = 0; i < shaders::kEffects.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(effectRules()[i].effect), i);
    EXPECT_TRUE(effectRules()[i].isOn) << i;
    EXPECT_FALSE(shaders::kEffects[i].description.empty()) << i;
    EXPECT_TRUE(shaders::kEffects[i].name.empty() || effectRules()[i].reason) << i;
  }
}

TEST(Effects, EarlierNamesAreAliases) {
  using shaders::Effect;
  for (const auto& [name, effect] : {std::pair("conductor", Effect::kMetal),
                                     {"transmission", Effect::kGlass},
                                     {"rough-reflection", Effect::kRoughness},
                                     {"polarizing-sheets", Effect::kPolarizingElement},
                                     {"polarized-sky", Effect::kSky}})
    EXPECT_EQ(effectNamed(name), effect) << name;
  EXPECT_FALSE(shaders::effectNamed(""));
  EXPECT_CONTAINS(test::errorOf([] { effectNamed("lambert"); }), "lambert");  // compiled in, not listed
}

TEST(Effects, MaterialsThatNoMeshHasDoNotCount) {
  pack::Scene scene = sceneOf({material(MaterialKind::glass), material(MaterialKind::metal)}, 8);
  scene.meshes.pop_back();
  scene.meshes[0].material = 1;
  const auto on = effectsOf(scene);
  EXPECT_TRUE(on.at("metal"));
  EXPECT_FALSE(on.at("dielectric"));
  EXPECT_FALSE(on.at("glass"));
}

TEST(Effects, KindsOfSurfaces) {
  auto on = effectsOf(sceneOf({material(MaterialKind::glass)}, 4));
  EXPECT_TRUE(on.at("dielectric") && on.at("glass") && on.at("tir"));
  EXPECT_FALSE(on.at("metal") || on.at("diffuse") || on.at("emitters"));
  on = effectsOf(sceneOf({material(MaterialKind::mirrorGlass)}, 4));
  EXPECT_TRUE(on.at("dielectric"));
  EXPECT_FALSE(on.at("glass") || on.at("tir"));
  on = effectsOf(sceneOf({material(MaterialKind::paint, 0.5)}, 4));
  EXPECT_TRUE(on.at("dielectric") && on.at("diffuse"));
  on = effectsOf(sceneOf({material(MaterialKind::emitter)}, 4));
  EXPECT_TRUE(on.at("emitters"));
  EXPECT_FALSE(on.at("dielectric"));
  on = effectsOf(sceneOf({material(MaterialKind::lambert, 0)}, 4));
  EXPECT_FALSE(on.at("diffuse"));  // black
}

TEST(Effects, TotalReflectionNeedsADenserSide) {
  Material matched = material(MaterialKind::glass);
  matched.outsideEta = 1.5;
  EXPECT_FALSE(effectsOf(sceneOf({matched}, 4)).at("tir"));
  EXPECT_FALSE(effectsOf(sceneOf({material(MaterialKind::glass)}, 0)).at("tir"));
  // Under water, a mirror of a rarer medium.
  Material submerged = material(MaterialKind::mirrorGlass);
  submerged.eta = glm::dvec3(1.2);
  submerged.outsideEta = 1.33;
  EXPECT_TRUE(effectsOf(sceneOf({submerged}, 4)).at("tir"));
}

TEST(Effects, WhatFewMaterialsHave) {
  const auto bits = [](Material m, std::uint32_t depth = 4) { return effectsOf(sceneOf({std::move(m)}, depth)); };
  Material glass = material(MaterialKind::glass);
  glass.absorption = {0, 1, 0};
  EXPECT_TRUE(bits(glass).at("absorption"));
  Material wet = material(MaterialKind::lambert, 0.5);
  wet.outsideAbsorption = {0, 0, 1};
  EXPECT_TRUE(bits(wet).at("absorption"));
  Material coated = material(MaterialKind::mirrorGlass);
  coated.coating.thicknessNm = 100;
  EXPECT_TRUE(bits(coated).at("coatings"));
  EXPECT_TRUE(bits(coated).at("circular-polarization"));  // films shift phases
  EXPECT_FALSE(bits(material(MaterialKind::mirrorGlass)).at("circular-polarization"));
  Material rough = material(MaterialKind::metal);
  rough.roughness = 0.1;
  EXPECT_TRUE(bits(rough).at("roughness"));
  EXPECT_FALSE(bits(rough, 0).at("roughness"));
  Material mapped = material(MaterialKind::lambert, 0.5);
  mapped.maps.albedo = 0;
  EXPECT_TRUE(bits(mapped).at("textures"));
  for (const MaterialKind kind : {MaterialKind::polarizer, MaterialKind::wavePlate})
    EXPECT_TRUE(bits(material(kind)).at("polarizing-elements"));
  for (const auto& [name, on] : effectsOf(sceneOf({material(MaterialKind::glass), material(MaterialKind::metal)}, 4)))
    for (const char* few :
         {"absorption", "coatings", "roughness", "textures", "polarizing-elements", "polarized-emitters", "sky"})
      EXPECT_FALSE(name == few && on) << name;
}

TEST(Effects, PolarizedSourcesAreTheFirstOfTwoDiattenuators) {
  Material display = material(MaterialKind::emitter);
  display.polarization = 1;
  auto scene = sceneOf({display}, 4);
  EXPECT_TRUE(effectsOf(scene).at("polarized-emitters"));
  EXPECT_FALSE(effectsOf(scene).at("linear-polarization"));  // seen by itself
  ImageRequest request;
  request.depth = 4;
  request.analyser = {0.5, 0.5, 0, 0};
  EXPECT_TRUE(isOn(findEffects(scene, request), "linear-polarization"));  // behind a filter
  scene = sceneOf({display, material(MaterialKind::mirrorGlass)}, 1);
  EXPECT_TRUE(effectsOf(scene).at("linear-polarization"));  // one mirror is enough
  scene.depth = 0;
  EXPECT_FALSE(effectsOf(scene).at("linear-polarization"));
  // The sky.
  scene = sceneOf({material(MaterialKind::mirrorGlass)}, 1);
  EXPECT_FALSE(effectsOf(scene).at("linear-polarization"));
  scene.environment.radiance = glm::dvec3(1);
  scene.environment.sun = {0, 1, 0};
  scene.environment.skyDegree = 0.8;
  EXPECT_TRUE(effectsOf(scene).at("sky"));
  EXPECT_TRUE(effectsOf(scene).at("linear-polarization"));
  // A polarizer and a mirror of glass (D = 1 both): (2 2 + 0)/2 - 1.
  scene = sceneOf({material(MaterialKind::polarizer)}, 2);
  scene.materials[0].transmittanceCrossed = glm::dvec3(0);
  request = {2, {1, 0, 0, 0}, false, false};
  EXPECT_DOUBLE_EQ(polarizationErrorBound(scene, request).x, 1);
}

// The renderers go by a sheet's numbers, not by its name; so does the analysis.
TEST(Effects, SheetsCountByTheirNumbers) {
  Material turner = material(MaterialKind::polarizer);
  turner.retardanceDegrees = glm::dvec3(90);
  EXPECT_TRUE(effectsOf(sceneOf({turner}, 4)).at("circular-polarization"));
  turner.retardanceDegrees = glm::dvec3(0);
  EXPECT_FALSE(effectsOf(sceneOf({turner}, 4)).at("circular-polarization"));
  Material plate = material(MaterialKind::wavePlate);
  plate.transmittanceCrossed = glm::dvec3(0);
  EXPECT_DOUBLE_EQ(polarizationErrorBound(sceneOf({plate}, 2), {2, {1, 0, 0, 0}, false, false}).x, 1);
}

// Far from the origin two facing mirrors are as near to each other as anywhere.
TEST(Effects, MirrorsFarFromTheOriginSeeEachOther) {
  pack::Scene scene = sceneOf({material(MaterialKind::mirrorGlass)}, 4);
  scene.meshes.resize(2, scene.meshes[0]);
  for (int i = 0; i < 2; ++i) {
    pack::Mesh& mesh = scene.meshes[static_cast<std::size_t>(i)];
    const float x = 1e5f + 0.5f * static_cast<float>(i);
    mesh.positions = {{x, 0, 0}, {x, 1, 0}, {x, 1, 1}};
    mesh.triangles = {i == 0 ? glm::uvec3(0, 1, 2) : glm::uvec3(0, 2, 1)};
  }
  EXPECT_TRUE(effectsOf(scene).at("linear-polarization"));
}

TEST(Effects, DeepestBounce) {
  // Two square mirrors of side 1 that face each other at distance 1: the most grazing way from corner to corner has a
  // cosine of 1/sqrt(3).
  const auto facing = [](MaterialKind kind, double distance) {
    pack::Scene scene = sceneOf({material(kind)}, 20);
    scene.meshes.resize(2, scene.meshes[0]);
    for (int i = 0; i < 2; ++i) {
      pack::Mesh& mesh = scene.meshes[static_cast<std::size_t>(i)];
      const auto z = static_cast<float>(i * distance);
      mesh.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
      mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
      if (i == 1) mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    }
    scene.camera.position = {0.5, 0.5, distance / 2};
    return scene;
  };
  const pack::Scene glass = facing(MaterialKind::mirrorGlass, 1);
  // From the eye in the middle too: k bounces leave R_s^k.
  const double c = 1 / std::sqrt(3.0), t = std::sqrt(1.25 + c * c), rs = std::pow(1.25 / ((c + t) * (c + t)), 2);
  EXPECT_EQ(deepestBounce(glass, 20, 0.999 * std::pow(rs, 3)), 3u);
  EXPECT_EQ(deepestBounce(glass, 2, 1e-9), 2u);
  EXPECT_LT(deepestBounce(glass, 20, 1e-3), deepestBounce(facing(MaterialKind::metal, 1), 20, 1e-3));
  EXPECT_EQ(deepestBounce(facing(MaterialKind::mirrorGlass, 1e-3), 20, 1e-3), 20u);  // grazing ways
  EXPECT_EQ(deepestBounce(facing(MaterialKind::glass, 1), 20, 1e-3), 20u);           // transmits
  EXPECT_EQ(deepestBounce(sceneOf({material(MaterialKind::lambert, 0.5)}, 20), 20, 1e-3), 0u);
  // A wide mirror under a low eye.
  pack::Scene water = glass;
  water.meshes.pop_back();
  for (glm::vec3& p : water.meshes[0].positions) p = (p - glm::vec3(0.5f, 0.5f, 0)) * 2e5f;
  water.camera.position = {0, 0, 0.5};
  EXPECT_EQ(deepestBounce(water, 20, 1e-3), 1u);
  pack::Scene alone = glass;
  alone.meshes.pop_back();
  EXPECT_EQ(deepestBounce(alone, 20, 1e-3), 1u);  // a flat mirror does not see itself
}

TEST(Effects, LinearPolarizationNeedsTwoDiattenuators) {
  const Material mirror = material(MaterialKind::mirrorGlass), paint = material(MaterialKind::paint, 0.5),
                 lambert = material(MaterialKind::lambert, 0.5);
  const auto linear = [](std::vector<Material> materials, std::uint32_t depth) {
    return effectsOf(sceneOf(std::move(materials), depth)).at("linear-polarization");
  };
  EXPECT_FALSE(linear({mirror}, 0));
  EXPECT_FALSE(linear({mirror}, 1));
  EXPECT_TRUE(linear({mirror}, 2));  // it may see itself
  EXPECT_FALSE(linear({mirror, lambert}, 1));
  EXPECT_TRUE(linear({mirror, paint}, 1));  // paint seen in a mirror leaves its light polarized
  EXPECT_FALSE(linear({paint}, 0));
  EXPECT_FALSE(linear({lambert}, 8));
  EXPECT_FALSE(linear({lambert, material(MaterialKind::emitter)}, 8));
}

TEST(Effects, CircularPolarizationNeedsTwoPhaseShiftersBetween) {
  const Material mirror = material(MaterialKind::mirrorGlass), gold = material(MaterialKind::metal),
                 paint = material(MaterialKind::paint, 0.5), glass = material(MaterialKind::glass);
  const auto circular = [](std::vector<Material> materials, std::uint32_t depth) {
    return effectsOf(sceneOf(std::move(materials), depth)).at("circular-polarization");
  };
  EXPECT_FALSE(circular({mirror}, 30));  // no phase
  EXPECT_FALSE(circular({gold}, 3));     // three mirrors: exactly 0
  EXPECT_TRUE(circular({gold}, 4));
  EXPECT_TRUE(circular({gold, paint}, 3));
  EXPECT_FALSE(circular({gold, paint}, 2));
  EXPECT_TRUE(circular({glass}, 4));  // total reflection
}

TEST(Effects, PointLights) {
  Material lambert = material(MaterialKind::lambert, 0.5), gold = material(MaterialKind::metal);
  pack::Scene scene = sceneOf({gold}, 4);
  scene.lights = {{{0, 1, 0}, {1, 1, 1}}};
  auto on = effectsOf(scene);
  EXPECT_FALSE(on.at("point-lights") || on.at("shadows") || on.at("highlights"));
  scene.materials[0].highlightStrength = 1;
  on = effectsOf(scene);
  EXPECT_TRUE(on.at("point-lights") && on.at("shadows") && on.at("highlights"));
  scene.depth = 0;  // a highlight takes a reflection
  EXPECT_FALSE(effectsOf(scene).at("highlights"));
  scene = sceneOf({lambert}, 0);
  EXPECT_FALSE(effectsOf(scene).at("shadows"));
  scene.lights = {{{0, 1, 0}, {1, 1, 1}}};
  on = effectsOf(scene);
  EXPECT_TRUE(on.at("shadows") && on.at("point-lights"));
  EXPECT_FALSE(on.at("highlights"));
}

TEST(Effects, Environment) {
  pack::Scene scene = sceneOf({}, 1);
  EXPECT_FALSE(effectsOf(scene).at("environment"));
  scene.environment.radiance.z = 0.1;
  EXPECT_TRUE(effectsOf(scene).at("environment"));
  scene.environment.radiance.z = 0;
  scene.environment.size = 4;
  EXPECT_TRUE(effectsOf(scene).at("environment"));
}

// A cube of side 1 about a place, outside outside; `faces` of its twelve triangles.
pack::Mesh cubeAt(const glm::vec3& place, std::size_t faces = 12) {
  pack::Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(place + glm::vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) - 0.5f);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  mesh.triangles.resize(faces);
  return mesh;
}
pack::Scene cubes(MaterialKind kind, std::vector<pack::Mesh> meshes) {
  pack::Scene scene = sceneOf({material(kind)}, 8);
  scene.meshes = std::move(meshes);
  scene.camera.position = {0, 0, 5};
  return scene;
}

TEST(Effects, InterfacesThatCannotSeeEachOtherNeedNoPolarization) {
  const auto linear = [](const pack::Scene& scene) { return effectsOf(scene).at("linear-polarization"); };
  // One flat mirror, one convex body of metal.
  EXPECT_FALSE(linear(cubes(MaterialKind::mirrorGlass, {cubeAt({0, 0, 0}, 2)})));
  const pack::Scene alone = cubes(MaterialKind::metal, {cubeAt({0, 0, 0})});
  EXPECT_FALSE(linear(alone));
  EXPECT_FALSE(effectsOf(alone).at("circular-polarization"));
  ImageRequest request;
  request.depth = 8;
  EXPECT_EQ(polarizationErrorBound(alone, request), glm::dvec3(0.0));
  // Two of them, an open one, one that the eye is in, one of clear glass: they do.
  EXPECT_TRUE(linear(cubes(MaterialKind::metal, {cubeAt({0, 0, 0}), cubeAt({3, 0, 0})})));
  EXPECT_TRUE(linear(cubes(MaterialKind::metal, {cubeAt({0, 0, 0}, 10)})));
  pack::Scene inside = alone;
  inside.camera.position = glm::dvec3(0.0);
  EXPECT_TRUE(linear(inside));
  EXPECT_TRUE(linear(cubes(MaterialKind::glass, {cubeAt({0, 0, 0})})));
}

TEST(Effects, APictureAsksForMore) {
  const pack::Scene gold = cubes(MaterialKind::metal, {cubeAt({0, 0, 0})});
  ImageRequest request;
  request.depth = 8;
  const auto on = [&](const pack::Scene& scene, const char* name) { return isOn(findEffects(scene, request), name); };
  EXPECT_FALSE(on(gold, "linear-polarization") || on(gold, "filter"));
  request.linearStokes = true;
  EXPECT_TRUE(on(gold, "linear-polarization"));
  request = {8, {0.5, 0.5, 0, 0}, false, false};
  EXPECT_TRUE(on(gold, "linear-polarization") && on(gold, "filter"));
  EXPECT_NEAR(polarizationErrorBound(cubes(MaterialKind::mirrorGlass, {cubeAt({0, 0, 0})}), request).x, 1, 1e-9)
      << "a filter in front of Brewster's angle: twice the light, or none";
  // Between a filter and a glass mirror two gold mirrors are enough for circular light, three depths in all.
  const pack::Scene both = sceneOf({material(MaterialKind::metal), material(MaterialKind::mirrorGlass)}, 3);
  request.depth = 3;
  EXPECT_TRUE(on(both, "circular-polarization"));
  request.analyser = {1, 0, 0, 0};
  EXPECT_FALSE(on(both, "circular-polarization"));
  request.circularStokes = true;
  EXPECT_TRUE(on(both, "circular-polarization"));
}

TEST(Effects, BoundIsTheFormula) {
  // Two glass mirrors: D reaches 1, (2 * 2 + 0)/2 - 1. Three: 3. Gold by colour: D of .05/.21/.52.
  ImageRequest request;
  for (const auto& [depth, bound] : {std::pair(1u, 0.0), {2u, 1.0}, {3u, 3.0}}) {
    request.depth = depth;
    EXPECT_NEAR(polarizationErrorBound(sceneOf({material(MaterialKind::mirrorGlass)}, depth), request).y, bound, 1e-9);
  }
  Material gold = material(MaterialKind::metal);
  gold.eta = {0.1884, 0.5439, 1.3319};
  gold.k = {3.4034, 2.2309, 1.8693};
  request.depth = 2;
  const glm::dvec3 d = polarizationErrorBound(sceneOf({gold}, 2), request);
  EXPECT_NEAR(std::sqrt(d.x), 0.05, 0.006);
  EXPECT_NEAR(std::sqrt(d.y), 0.21, 0.006);
  EXPECT_NEAR(std::sqrt(d.z), 0.52, 0.006);
}

TEST(Effects, SceneWithoutThem) {
  pack::Scene scene = test::smallScene();
  const auto without = [&](const char* name) { return withoutEffects(scene, {name}); };
  EXPECT_TRUE(without("point-lights").lights.empty());
  EXPECT_EQ(without("environment").environment.size, 0u);
  EXPECT_EQ(without("highlights").materials[1].highlightStrength, 0);
  EXPECT_EQ(without("emitters").materials[2].radiance, glm::dvec3(0.0));
  EXPECT_EQ(without("glass").materials[0].kind, MaterialKind::mirrorGlass);
  EXPECT_EQ(without("metal").materials[1].kind, MaterialKind::lambert);
  EXPECT_EQ(without("diffuse").materials[1].albedo, glm::dvec3(0.0));
  // These four the renderer leaves out: they are no part of a scene.
  const std::set<std::string> rendering = {"linear-polarization", "circular-polarization", "shadows", "filter"};
  for (const std::string& name : effectNames())
    if (name != "tir" && !rendering.contains(name)) {
      EXPECT_FALSE(isOn(findEffects(withoutEffects(scene, {name})), name)) << name;
    }
  EXPECT_CONTAINS(test::errorOf([&] { without("magic"); }), "linear-polarization, ");
  EXPECT_CONTAINS(test::errorOf([&] { without("tir"); }), "tir");
}

}  // namespace
}  // namespace malus::bake
