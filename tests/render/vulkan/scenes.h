// Scenes for the tests of the Vulkan renderer.
#pragma once

#include <glm/geometric.hpp>

#include "tests/render/test_scene.h"

namespace malus::test {

// A gold square in front of an environment: few shaders to compile.
inline pack::Scene goldScene() {
  pack::Scene scene = emptyScene(1);
  scene.width = scene.height = 4;
  scene.camera.verticalFovDegrees = 50;
  scene.environment.radiance = {0.2, 0.3, 0.5};
  const auto gold = addMaterial(scene, metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
  addSquare(scene, gold, {0, 0, 0}, {0, 0, 1}, 1);
  look(scene, {0, 0, 4}, {0, 0, 0});
  return scene;
}

// The same above a paint floor, with a point light: reflections, shadow rays and diffuse light.
inline pack::Scene goldAndPaintScene() {
  pack::Scene scene = goldScene();
  scene.depth = 2;
  const auto paint = addMaterial(scene, dielectric(pack::MaterialKind::paint, 1.5, 0.6));
  addSquare(scene, paint, {0, -1, 0}, {0, 1, 0.2}, 2);
  scene.lights.push_back({{1, 1.5, 2}, {6, 6, 6}});
  look(scene, {0.3, 0.2, 4}, {0, 0, 0});
  return scene;
}

// A paint floor, a glass pane, a metal wall, a lambert wall, an emitter and a point light.
inline pack::Scene mixedScene() {
  pack::Scene scene = emptyScene(4);
  scene.width = 48;
  scene.height = 32;
  scene.camera.verticalFovDegrees = 50;
  scene.environment.radiance = {0.2, 0.3, 0.5};
  scene.environment.ambientIrradiance = 0.5;
  scene.environment.irradiance[0] = {0.6, 0.9, 1.5};
  pack::Material paint = dielectric(pack::MaterialKind::paint, 1.5, 0.6);
  paint.highlightStrength = 1;
  paint.highlightExponent = 100;
  pack::Material lambert;
  lambert.albedo = {0.7, 0.2, 0.1};
  const auto floor = addMaterial(scene, paint);
  const auto glass = addMaterial(scene, dielectric(pack::MaterialKind::glass, 1.5));
  const auto gold = addMaterial(scene, metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
  const auto wall = addMaterial(scene, lambert);
  const auto lamp = addMaterial(scene, emitter({5, 5, 5}));
  addSquare(scene, floor, {0, -1, 0}, {0, 1, 0}, 3);
  addSquare(scene, glass, {0.4, 0, 0.5}, {0, 0, 1}, 0.8);
  addSquare(scene, glass, {0.4, 0, 0.45}, {0, 0, -1}, 0.8);
  addSquare(scene, gold, {-2, 0, 0}, {1, 0, 0.4}, 1.5);
  addSquare(scene, wall, {0, 0, -3}, {0, 0, 1}, 3);
  addSquare(scene, lamp, {1, 2, 0}, {0, -1, 0}, 0.5);
  scene.lights.push_back({{1, 1.5, 2}, {6, 6, 6}});
  look(scene, {0.5, 0.5, 4}, {0, -0.2, 0});
  return scene;
}

// The same with a rough wall, a coated floor, absorbing glass, a polarizer, a wave plate, a thin pane, a display and a
// clear sky: every effect but textures.
inline pack::Scene everyEffectScene() {
  pack::Scene scene = mixedScene();
  scene.materials[0].coating = {glm::dvec3(1.38), 140};
  scene.materials[1].absorption = {0.4, 0.2, 0.9};
  scene.materials[2].roughness = 0.3;
  scene.materials[4].axis = {1, 0, 0};
  scene.materials[4].polarization = 0.8;
  scene.environment.sun = glm::normalize(glm::dvec3(0.3, 1, 0.5));
  scene.environment.skyDegree = 0.8;
  pack::Material polarizer;
  polarizer.name = "polarizer";
  polarizer.kind = pack::MaterialKind::polarizer;
  polarizer.axis = glm::normalize(glm::dvec3(1, 1, 0));
  polarizer.transmittanceCrossed = glm::dvec3(0);
  pack::Material plate = polarizer;
  plate.name = "plate";
  plate.kind = pack::MaterialKind::wavePlate;
  plate.transmittanceCrossed = glm::dvec3(1);
  plate.retardanceDegrees = {80, 90, 100};
  addSquare(scene, addMaterial(scene, polarizer), {-0.6, 0.3, 1.5}, {0, 0, 1}, 0.5);
  addSquare(scene, addMaterial(scene, plate), {-0.4, 0.2, 1.2}, {0, 0, 1}, 0.5);
  addSquare(scene, addMaterial(scene, dielectric(pack::MaterialKind::thinGlass, 1.5)), {1.2, 0, 1.5}, {0.2, 0, 1}, 0.6);
  return scene;
}

}  // namespace malus::test
