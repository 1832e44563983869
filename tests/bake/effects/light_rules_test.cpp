// Effects of light sources: the rules of bake/effects/light_rules.cpp.
#include "bake/effects/polarization_bound.h"

#include "tests/bake/effects/effect_scene.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using pack::Material;
using pack::MaterialKind;

TEST(Effects, PointLights) {
  Material lambert = material(MaterialKind::lambert, 0.5), gold = material(MaterialKind::metal);
  pack::Scene scene = makeScene({gold}, 4);
  scene.lights = {{{0, 1, 0}, {1, 1, 1}}};
  auto on = effectStates(scene);
  EXPECT_FALSE(on.at("point-lights") || on.at("shadows") || on.at("highlights"));
  scene.materials[0].highlightStrength = 1;
  on = effectStates(scene);
  EXPECT_TRUE(on.at("point-lights") && on.at("shadows") && on.at("highlights"));
  scene.depth = 0;  // a highlight needs one reflection
  EXPECT_FALSE(effectStates(scene).at("highlights"));
  scene = makeScene({lambert}, 0);
  EXPECT_FALSE(effectStates(scene).at("shadows"));
  scene.lights = {{{0, 1, 0}, {1, 1, 1}}};
  on = effectStates(scene);
  EXPECT_TRUE(on.at("shadows") && on.at("point-lights"));
  EXPECT_FALSE(on.at("highlights"));
}

// The reason of an effect of a scene with one diffuse surface.
std::string lightReason(const std::string& name, const std::vector<pack::LightSource>& lights) {
  pack::Scene scene = makeScene({material(MaterialKind::lambert, 0.5)}, 0);
  scene.lights = lights;
  for (const pack::Effect& e : findEffects(scene))
    if (e.name == name) return e.reason;
  return "no such effect";
}

TEST(Effects, LightsAreNamedByTheirKinds) {
  pack::LightSource point, spot, sun;
  spot.kind = pack::LightKind::spot;
  sun.kind = pack::LightKind::directional;
  EXPECT_EQ(lightReason("point-lights", {point}), "1 point light");
  EXPECT_EQ(lightReason("point-lights", {sun}), "1 directional light");
  EXPECT_EQ(lightReason("point-lights", {sun, point, spot, point}),
            "2 point lights, 1 spot light, 1 directional light");
  EXPECT_EQ(lightReason("point-lights", {}), "no point, spot or directional light");
}

TEST(Effects, Environment) {
  pack::Scene scene = makeScene({}, 1);
  EXPECT_FALSE(effectStates(scene).at("environment"));
  scene.environment.radiance.z = 0.1;
  EXPECT_TRUE(effectStates(scene).at("environment"));
  scene.environment.radiance.z = 0;
  scene.environment.size = 4;
  EXPECT_TRUE(effectStates(scene).at("environment"));
}

// A square of side 2 about a centre in a plane of constant z, facing along +z or -z.
pack::Mesh squareAt(double z, bool up, std::uint32_t material) {
  pack::Mesh mesh;
  mesh.material = material;
  mesh.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (!up) mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  return mesh;
}

TEST(Effects, AreaLightsNeedADiffuseSurfaceBeforeThem) {
  Material lamp = material(MaterialKind::emitter);
  pack::Scene scene = makeScene({material(MaterialKind::lambert, 0.5), lamp}, 1);
  scene.meshes = {squareAt(0, true, 0), squareAt(1, false, 1)};
  EXPECT_FALSE(effectStates(scene).at("area-lights"));
  scene.materials[1].illuminates = true;
  EXPECT_TRUE(effectStates(scene).at("area-lights"));
  EXPECT_TRUE(effectStates(scene).at("shadows"));
  EXPECT_FALSE(effectStates(scene).at("point-lights"));
  EXPECT_FALSE(effectStates(withoutEffects(scene, {"area-lights"})).at("area-lights"));
  scene.meshes[1] = squareAt(1, true, 1);  // it faces away
  EXPECT_FALSE(effectStates(scene).at("area-lights"));
  EXPECT_FALSE(effectStates(scene).at("shadows"));
  scene.materials[1].twoSided = true;
  EXPECT_TRUE(effectStates(scene).at("area-lights"));
  scene.meshes[1] = squareAt(0, true, 1);  // in the plane of the surface
  EXPECT_FALSE(effectStates(scene).at("area-lights"));
  scene.meshes[1] = squareAt(1, false, 1);
  scene.materials[0].albedo = glm::dvec3(0);
  EXPECT_FALSE(effectStates(scene).at("area-lights"));
}

TEST(Effects, EnvironmentLightReplacesTheAmbientIrradiance) {
  pack::Scene scene = makeScene({material(MaterialKind::lambert, 0.5)}, 1);
  scene.environment.radiance = glm::dvec3(1);
  scene.environment.ambientIrradiance = 1;
  EXPECT_FALSE(effectStates(scene).at("environment-light"));
  const auto compiles = [&](shaders::Effect effect) {
    return (findCompiledEffects(scene, {1}) & shaders::effectBit(effect)) != 0;
  };
  EXPECT_TRUE(compiles(shaders::Effect::kAmbient));
  scene.environment.illuminates = true;
  EXPECT_TRUE(effectStates(scene).at("environment-light"));
  EXPECT_TRUE(effectStates(scene).at("shadows"));
  EXPECT_FALSE(compiles(shaders::Effect::kAmbient));
  scene = withoutEffects(scene, {"environment-light"});
  EXPECT_TRUE(compiles(shaders::Effect::kAmbient));
  EXPECT_FALSE(effectStates(scene).at("environment-light"));
}

TEST(Effects, FilteredShadowsNeedLightsAndThinSurfaces) {
  for (const MaterialKind kind : {MaterialKind::polarizer, MaterialKind::wavePlate, MaterialKind::thinGlass}) {
    pack::Scene scene = makeScene({material(MaterialKind::lambert, 0.5), material(kind)}, 1);
    EXPECT_FALSE(effectStates(scene).at("filtered-shadows"));
    scene.lights = {{{0, 1, 0}, {1, 1, 1}}};
    EXPECT_TRUE(effectStates(scene).at("filtered-shadows"));
    // Polarized light enters paint, not a bare diffuse surface.
    EXPECT_EQ(effectStates(scene).at("linear-polarization"), false) << static_cast<int>(kind);
    scene.materials[0] = material(MaterialKind::paint, 0.5);
    EXPECT_TRUE(effectStates(scene).at("linear-polarization"));
    EXPECT_GT(polarizationErrorBound(scene, {1}).x, 0);
  }
  pack::Scene body = makeScene({material(MaterialKind::lambert, 0.5), material(MaterialKind::glass)}, 1);
  body.lights = {{{0, 1, 0}, {1, 1, 1}}};
  EXPECT_FALSE(effectStates(body).at("filtered-shadows"));
}

}  // namespace
}  // namespace malus::bake
