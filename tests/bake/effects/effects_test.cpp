// Which effects a scene calls for. When polarization may be left out is the theorem of shaders/optics: at
// most one diattenuating element between the camera and every contribution.
#include "bake/effects/effects.h"

#include <map>

#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using pack::Material;
using pack::MaterialKind;

Material material(MaterialKind kind, double albedo = 0) {
  Material m;
  m.name = std::string(pack::nameOf(kind));
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
  EXPECT_EQ(names,
            (std::vector<std::string>{"diffuse", "textures", "dielectric", "conductor", "transmission", "absorption",
                                      "tir", "linear-polarization", "circular-polarization", "shadows", "point-lights",
                                      "highlights", "emitters", "environment", "filter"}));
}

TEST(Effects, MaterialsThatNoMeshHasDoNotCount) {
  pack::Scene scene = sceneOf({material(MaterialKind::glass), material(MaterialKind::metal)}, 8);
  scene.meshes.pop_back();
  scene.meshes[0].material = 1;
  const auto on = effectsOf(scene);
  EXPECT_TRUE(on.at("conductor"));
  EXPECT_FALSE(on.at("dielectric"));
  EXPECT_FALSE(on.at("transmission"));
}

TEST(Effects, KindsOfSurfaces) {
  auto on = effectsOf(sceneOf({material(MaterialKind::glass)}, 4));
  EXPECT_TRUE(on.at("dielectric") && on.at("transmission") && on.at("tir"));
  EXPECT_FALSE(on.at("conductor") || on.at("diffuse") || on.at("emitters"));
  on = effectsOf(sceneOf({material(MaterialKind::mirrorGlass)}, 4));
  EXPECT_TRUE(on.at("dielectric"));
  EXPECT_FALSE(on.at("transmission") || on.at("tir"));
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

}  // namespace
}  // namespace malus::bake
