// Effects that a scene requires. Polarization may be omitted if at most one diattenuating element is between the
// camera and every contribution (see shaders/optics).
#include "bake/effects/effects.h"

#include <cmath>
#include <map>
#include <set>

#include "bake/effects/deepest_bounce.h"
#include "bake/effects/polarization_bound.h"
#include "bake/effects/rules.h"

#include "tests/bake/effects/effect_scene.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using pack::Material;
using pack::MaterialKind;

TEST(Effects, AllOfThemInOrder) {
  std::vector<std::string> names;
  for (const pack::Effect& e : findEffects(makeScene({}, 4))) {
    names.push_back(e.name);
    EXPECT_FALSE(e.on) << e.name;  // an empty scene
  }
  EXPECT_EQ(names, effectNames());
  EXPECT_EQ(names, (std::vector<std::string>{"metal",
                                             "glass",
                                             "polarizing-elements",
                                             "thin-glass",
                                             "point-lights",
                                             "shadows",
                                             "highlights",
                                             "textures",
                                             "absorption",
                                             "coatings",
                                             "roughness",
                                             "sky",
                                             "polarized-emitters",
                                             "area-lights",
                                             "environment-light",
                                             "filtered-shadows",
                                             "mesh-textures",
                                             "normal-maps",
                                             "cut-outs",
                                             "specular-factors",
                                             "tinted-glass",
                                             "clear-coats",
                                             "diffuse",
                                             "dielectric",
                                             "tir",
                                             "linear-polarization",
                                             "circular-polarization",
                                             "emitters",
                                             "environment",
                                             "filter"}));
}

// Each row of shaders/effects.def has one rule, in the same order; listed effects have a description.
TEST(Effects, EveryEffectHasARule) {
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
  EXPECT_CONTAINS(test::errorMessage([] { effectNamed("lambert"); }), "lambert");  // compiled in, not listed
}

TEST(Effects, UnusedMaterialsDoNotCount) {
  pack::Scene scene = makeScene({material(MaterialKind::glass), material(MaterialKind::metal)}, 8);
  scene.meshes.pop_back();
  scene.meshes[0].material = 1;
  const auto on = effectStates(scene);
  EXPECT_TRUE(on.at("metal"));
  EXPECT_FALSE(on.at("dielectric"));
  EXPECT_FALSE(on.at("glass"));
}

TEST(Effects, KindsOfSurfaces) {
  auto on = effectStates(makeScene({material(MaterialKind::glass)}, 4));
  EXPECT_TRUE(on.at("dielectric") && on.at("glass") && on.at("tir"));
  EXPECT_FALSE(on.at("metal") || on.at("diffuse") || on.at("emitters"));
  on = effectStates(makeScene({material(MaterialKind::mirrorGlass)}, 4));
  EXPECT_TRUE(on.at("dielectric"));
  EXPECT_FALSE(on.at("glass") || on.at("tir"));
  on = effectStates(makeScene({material(MaterialKind::paint, 0.5)}, 4));
  EXPECT_TRUE(on.at("dielectric") && on.at("diffuse"));
  on = effectStates(makeScene({material(MaterialKind::emitter)}, 4));
  EXPECT_TRUE(on.at("emitters"));
  EXPECT_FALSE(on.at("dielectric"));
  on = effectStates(makeScene({material(MaterialKind::lambert, 0)}, 4));
  EXPECT_FALSE(on.at("diffuse"));  // black
}

TEST(Effects, TotalReflectionNeedsADenserSide) {
  Material matched = material(MaterialKind::glass);
  matched.outsideEta = 1.5;
  EXPECT_FALSE(effectStates(makeScene({matched}, 4)).at("tir"));
  EXPECT_FALSE(effectStates(makeScene({material(MaterialKind::glass)}, 0)).at("tir"));
  // A mirror of a less dense medium under water.
  Material submerged = material(MaterialKind::mirrorGlass);
  submerged.eta = glm::dvec3(1.2);
  submerged.outsideEta = 1.33;
  EXPECT_TRUE(effectStates(makeScene({submerged}, 4)).at("tir"));
}

TEST(Effects, OptionalMaterialProperties) {
  const auto bits = [](Material m, std::uint32_t depth = 4) { return effectStates(makeScene({std::move(m)}, depth)); };
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
  Material partial = material(MaterialKind::paint);
  partial.specularFactor = 0.5;
  EXPECT_TRUE(bits(partial).at("specular-factors"));
  Material varnished = material(MaterialKind::metal);
  varnished.clearCoat.factor = 0.5;
  EXPECT_TRUE(bits(varnished).at("clear-coats"));
  EXPECT_FALSE(bits(varnished).at("specular-factors"));
  Material tinted = material(MaterialKind::glass);
  tinted.transmittanceParallel = {1, 0.5, 1};
  EXPECT_TRUE(bits(tinted).at("tinted-glass"));
  tinted.kind = MaterialKind::thinGlass;  // within the pane
  EXPECT_FALSE(bits(tinted).at("tinted-glass"));
  Material rough = material(MaterialKind::metal);
  rough.roughness = 0.1;
  EXPECT_TRUE(bits(rough).at("roughness"));
  EXPECT_FALSE(bits(rough, 0).at("roughness"));
  Material mapped = material(MaterialKind::lambert, 0.5);
  mapped.maps.albedo = 0;
  EXPECT_TRUE(bits(mapped).at("textures"));
  for (const MaterialKind kind : {MaterialKind::polarizer, MaterialKind::wavePlate})
    EXPECT_TRUE(bits(material(kind)).at("polarizing-elements"));
  for (const auto& [name, on] :
       effectStates(makeScene({material(MaterialKind::glass), material(MaterialKind::metal)}, 4)))
    for (const char* few : {"absorption", "coatings", "roughness", "textures", "polarizing-elements",
                            "polarized-emitters", "sky", "specular-factors", "tinted-glass", "clear-coats"})
      EXPECT_FALSE(name == few && on) << name;
}

TEST(Effects, PolarizedSourcesAreTheFirstOfTwoDiattenuators) {
  Material display = material(MaterialKind::emitter);
  display.polarization = 1;
  auto scene = makeScene({display}, 4);
  EXPECT_TRUE(effectStates(scene).at("polarized-emitters"));
  EXPECT_FALSE(effectStates(scene).at("linear-polarization"));  // seen directly
  ImageRequest request;
  request.depth = 4;
  request.analyser = {0.5, 0.5, 0, 0};
  EXPECT_TRUE(isOn(findEffects(scene, request), "linear-polarization"));  // behind a filter
  scene = makeScene({display, material(MaterialKind::mirrorGlass)}, 1);
  EXPECT_TRUE(effectStates(scene).at("linear-polarization"));  // one mirror is enough
  scene.depth = 0;
  EXPECT_FALSE(effectStates(scene).at("linear-polarization"));
  // A polarized sky.
  scene = makeScene({material(MaterialKind::mirrorGlass)}, 1);
  EXPECT_FALSE(effectStates(scene).at("linear-polarization"));
  scene.environment.radiance = glm::dvec3(1);
  scene.environment.sun = {0, 1, 0};
  scene.environment.skyDegree = 0.8;
  EXPECT_TRUE(effectStates(scene).at("sky"));
  EXPECT_TRUE(effectStates(scene).at("linear-polarization"));
  // A polarizer and a mirror of glass (D = 1 both): (2 2 + 0)/2 - 1.
  scene = makeScene({material(MaterialKind::polarizer)}, 2);
  scene.materials[0].transmittanceCrossed = glm::dvec3(0);
  request = {2, {1, 0, 0, 0}, false, false};
  EXPECT_DOUBLE_EQ(polarizationErrorBound(scene, request).x, 1);
}

// Renderers and analysis use the parameters of a polarizing element, not its kind.
TEST(Effects, PolarizingElementsCountByTheirParameters) {
  Material retarder = material(MaterialKind::polarizer);
  retarder.retardanceDegrees = glm::dvec3(90);
  EXPECT_TRUE(effectStates(makeScene({retarder}, 4)).at("circular-polarization"));
  retarder.retardanceDegrees = glm::dvec3(0);
  EXPECT_FALSE(effectStates(makeScene({retarder}, 4)).at("circular-polarization"));
  Material plate = material(MaterialKind::wavePlate);
  plate.transmittanceCrossed = glm::dvec3(0);
  EXPECT_DOUBLE_EQ(polarizationErrorBound(makeScene({plate}, 2), {2, {1, 0, 0, 0}, false, false}).x, 1);
}

// A coat of a lower index than the medium reflects totally, which shifts phases.
TEST(Effects, TotalReflectionInAClearCoat) {
  Material coated = material(MaterialKind::mirrorGlass);
  coated.outsideEta = 1.33;
  coated.clearCoat.eta = 1.1;
  coated.clearCoat.factor = 0.5;
  const auto states = [&] { return effectStates(makeScene({coated}, 4)); };
  EXPECT_TRUE(states().at("tir"));
  EXPECT_TRUE(states().at("circular-polarization"));
  coated.clearCoat.eta = 1.4;
  EXPECT_FALSE(states().at("tir"));
  EXPECT_FALSE(states().at("circular-polarization"));
}

// The distance of two facing mirrors does not depend on their distance to the origin.
TEST(Effects, MirrorsFarFromTheOriginSeeEachOther) {
  pack::Scene scene = makeScene({material(MaterialKind::mirrorGlass)}, 4);
  scene.meshes.resize(2, scene.meshes[0]);
  for (int i = 0; i < 2; ++i) {
    pack::Mesh& mesh = scene.meshes[static_cast<std::size_t>(i)];
    const float x = 1e5f + 0.5f * static_cast<float>(i);
    mesh.positions = {{x, 0, 0}, {x, 1, 0}, {x, 1, 1}};
    mesh.triangles = {i == 0 ? glm::uvec3(0, 1, 2) : glm::uvec3(0, 2, 1)};
  }
  EXPECT_TRUE(effectStates(scene).at("linear-polarization"));
}

TEST(Effects, DeepestBounce) {
  // Two square mirrors of side 1 that face each other at distance 1: the most grazing path, from corner to corner, has
  // the cosine 1/sqrt(3).
  const auto facing = [](MaterialKind kind, double distance) {
    pack::Scene scene = makeScene({material(kind)}, 20);
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
  // The camera is in the middle; k bounces leave R_s^k.
  const double c = 1 / std::sqrt(3.0), t = std::sqrt(1.25 + c * c), rs = std::pow(1.25 / ((c + t) * (c + t)), 2);
  EXPECT_EQ(deepestBounce(glass, 20, 0.999 * std::pow(rs, 3)), 3u);
  EXPECT_EQ(deepestBounce(glass, 2, 1e-9), 2u);
  EXPECT_LT(deepestBounce(glass, 20, 1e-3), deepestBounce(facing(MaterialKind::metal, 1), 20, 1e-3));
  EXPECT_EQ(deepestBounce(facing(MaterialKind::mirrorGlass, 1e-3), 20, 1e-3), 20u);  // grazing paths
  EXPECT_EQ(deepestBounce(facing(MaterialKind::glass, 1), 20, 1e-3), 20u);           // transmits
  EXPECT_EQ(deepestBounce(makeScene({material(MaterialKind::lambert, 0.5)}, 20), 20, 1e-3), 0u);
  // A wide mirror below a low camera.
  pack::Scene water = glass;
  water.meshes.pop_back();
  for (glm::dvec3& p : water.meshes[0].positions) p = (p - glm::dvec3(0.5, 0.5, 0)) * 2e5;
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
    return effectStates(makeScene(std::move(materials), depth)).at("linear-polarization");
  };
  EXPECT_FALSE(linear({mirror}, 0));
  EXPECT_FALSE(linear({mirror}, 1));
  EXPECT_TRUE(linear({mirror}, 2));  // it may reflect itself
  EXPECT_FALSE(linear({mirror, lambert}, 1));
  EXPECT_TRUE(linear({mirror, paint}, 1));  // light from paint is polarized when seen in a mirror
  EXPECT_FALSE(linear({paint}, 0));
  EXPECT_FALSE(linear({lambert}, 8));
  EXPECT_FALSE(linear({lambert, material(MaterialKind::emitter)}, 8));
}

TEST(Effects, CircularPolarizationNeedsTwoPhaseShiftersBetween) {
  const Material mirror = material(MaterialKind::mirrorGlass), gold = material(MaterialKind::metal),
                 paint = material(MaterialKind::paint, 0.5), glass = material(MaterialKind::glass);
  const auto circular = [](std::vector<Material> materials, std::uint32_t depth) {
    return effectStates(makeScene(std::move(materials), depth)).at("circular-polarization");
  };
  EXPECT_FALSE(circular({mirror}, 30));  // no phase
  EXPECT_FALSE(circular({gold}, 3));     // three mirrors: exactly 0
  EXPECT_TRUE(circular({gold}, 4));
  EXPECT_TRUE(circular({gold, paint}, 3));
  EXPECT_FALSE(circular({gold, paint}, 2));
  EXPECT_TRUE(circular({glass}, 4));  // total reflection
}

// The first `faces` triangles of a cube of side 1 around `centre`, facing outward.
pack::Mesh cubeAt(const glm::dvec3& centre, std::size_t faces = 12) {
  pack::Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(centre + glm::dvec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) - 0.5);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  mesh.triangles.resize(faces);
  return mesh;
}
pack::Scene cubes(MaterialKind kind, std::vector<pack::Mesh> meshes) {
  pack::Scene scene = makeScene({material(kind)}, 8);
  scene.meshes = std::move(meshes);
  scene.camera.position = {0, 0, 5};
  return scene;
}

TEST(Effects, InterfacesThatCannotSeeEachOtherNeedNoPolarization) {
  const auto linear = [](const pack::Scene& scene) { return effectStates(scene).at("linear-polarization"); };
  // Not needed for one flat mirror and for one convex metal solid.
  EXPECT_FALSE(linear(cubes(MaterialKind::mirrorGlass, {cubeAt({0, 0, 0}, 2)})));
  const pack::Scene alone = cubes(MaterialKind::metal, {cubeAt({0, 0, 0})});
  EXPECT_FALSE(linear(alone));
  EXPECT_FALSE(effectStates(alone).at("circular-polarization"));
  ImageRequest request;
  request.depth = 8;
  EXPECT_EQ(polarizationErrorBound(alone, request), glm::dvec3(0.0));
  // Needed for two solids, an open mesh, a solid around the camera and clear glass.
  EXPECT_TRUE(linear(cubes(MaterialKind::metal, {cubeAt({0, 0, 0}), cubeAt({3, 0, 0})})));
  EXPECT_TRUE(linear(cubes(MaterialKind::metal, {cubeAt({0, 0, 0}, 10)})));
  pack::Scene inside = alone;
  inside.camera.position = glm::dvec3(0.0);
  EXPECT_TRUE(linear(inside));
  EXPECT_TRUE(linear(cubes(MaterialKind::glass, {cubeAt({0, 0, 0})})));
}

TEST(Effects, ImageRequestAddsEffects) {
  const pack::Scene gold = cubes(MaterialKind::metal, {cubeAt({0, 0, 0})});
  ImageRequest request;
  request.depth = 8;
  const auto on = [&](const pack::Scene& scene, const char* name) { return isOn(findEffects(scene, request), name); };
  EXPECT_FALSE(on(gold, "linear-polarization") || on(gold, "filter"));
  request.linearStokes = true;
  EXPECT_TRUE(on(gold, "linear-polarization"));
  request = {8, {0.5, 0.5, 0, 0}, false, false};
  EXPECT_TRUE(on(gold, "linear-polarization") && on(gold, "filter"));
  pack::Scene glass = cubes(MaterialKind::mirrorGlass, {cubeAt({0, 0, 0})});
  EXPECT_LT(polarizationErrorBound(glass, request).x, 0.6) << "too steep or too grazing for Brewster's angle";
  glass.camera.position = {1.5, 0, 1.5};
  EXPECT_NEAR(polarizationErrorBound(glass, request).x, 1, 1e-9)
      << "a filter in front of Brewster's angle: twice the light, or none";
  // Between a filter and a glass mirror two gold mirrors are enough for circular light, three depths in all.
  const pack::Scene both = makeScene({material(MaterialKind::metal), material(MaterialKind::mirrorGlass)}, 3);
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
    EXPECT_NEAR(polarizationErrorBound(makeScene({material(MaterialKind::mirrorGlass)}, depth), request).y, bound,
                1e-9);
  }
  Material gold = material(MaterialKind::metal);
  gold.eta = {0.1884, 0.5439, 1.3319};
  gold.k = {3.4034, 2.2309, 1.8693};
  request.depth = 2;
  const glm::dvec3 d = polarizationErrorBound(makeScene({gold}, 2), request);
  EXPECT_NEAR(std::sqrt(d.x), 0.05, 0.006);
  EXPECT_NEAR(std::sqrt(d.y), 0.21, 0.006);
  EXPECT_NEAR(std::sqrt(d.z), 0.52, 0.006);
}

TEST(Effects, SceneWithoutEffects) {
  pack::Scene scene = test::smallScene();
  const auto without = [&](const char* name) { return withoutEffects(scene, {name}); };
  EXPECT_TRUE(without("point-lights").lights.empty());
  EXPECT_EQ(without("environment").environment.size, 0u);
  EXPECT_EQ(without("highlights").materials[1].highlightStrength, 0);
  EXPECT_EQ(without("emitters").materials[2].radiance, glm::dvec3(0.0));
  EXPECT_EQ(without("glass").materials[0].kind, MaterialKind::mirrorGlass);
  EXPECT_EQ(without("metal").materials[1].kind, MaterialKind::lambert);
  EXPECT_EQ(without("diffuse").materials[1].albedo, glm::dvec3(0.0));
  // The renderer handles these; they are not part of a scene.
  const std::set<std::string> rendering = {"linear-polarization", "circular-polarization", "shadows",
                                           "filtered-shadows", "filter"};
  for (const std::string& name : effectNames()) {
    EXPECT_EQ(canBeRemoved({name}), name != "tir" && !rendering.contains(name)) << name;
    if (canBeRemoved({name})) {
      EXPECT_FALSE(isOn(findEffects(withoutEffects(scene, {name})), name)) << name;
    }
  }
  EXPECT_FALSE(canBeRemoved({}));
  EXPECT_TRUE(canBeRemoved({"shadows", "conductor"}));
  EXPECT_CONTAINS(test::errorMessage([&] { without("magic"); }), "linear-polarization, ");
  EXPECT_CONTAINS(test::errorMessage([&] { without("tir"); }), "tir");
}

}  // namespace
}  // namespace malus::bake
