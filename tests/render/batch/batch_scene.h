// A scene for batches: every kind of material that frames change.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "render/batch/frame.h"
#include "tests/render/test_scene.h"

namespace malus::test {

inline pack::Material named(const std::string& name, pack::Material material) {
  material.name = name;
  return material;
}

inline pack::Pack batchPack() {
  pack::Pack pack;
  pack.hash = 0x1234;
  pack::Scene& scene = pack.scene;
  scene = emptyScene(5);
  scene.width = 24;
  scene.height = 18;
  scene.origin = {10, 0, -3};
  scene.camera.verticalFovDegrees = 60;
  const std::uint32_t gold = addMaterial(scene, named("gold", metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}))),
                      paint = addMaterial(scene, named("wall", dielectric(pack::MaterialKind::paint, 1.5, 0.6))),
                      pane = addMaterial(scene, named("pane", dielectric(pack::MaterialKind::thinGlass, 1.5))),
                      lamp = addMaterial(scene, named("lamp", emitter(glm::dvec3(4))));
  scene.materials[lamp].illuminates = true;
  addSquare(scene, paint, {0, 0, 0}, {0, 0, 1}, 3);
  addSquare(scene, gold, {1.5, 0, 1}, {-1, 0, 0.5}, 1);
  addSquare(scene, pane, {-1, 0, 1}, {0.3, 0, 1}, 0.7);
  addSquare(scene, lamp, {0, 2, 3}, {0, -0.5, -1}, 0.4);
  scene.lights = {{{-2, -1, 3}, {5, 6, 7}}, {{2, -1, 3}, {1, 2, 1}}};
  bake::bakeConstantEnvironment({0.2, 0.3, 0.4}, scene.environment);
  scene.environment.ambientIrradiance = 1;
  look(scene, {0, -1, 5}, {0, 0, 0});
  return pack;
}

inline render::FrameDefaults batchDefaults() {
  render::FrameDefaults defaults;
  defaults.job.method = "stokes";
  defaults.job.threads = 1;
  return defaults;
}

inline render::Frame readFrame(const std::string& settings, const pack::Scene& scene) {
  render::FrameJob job;
  job.name = "frame";
  job.settings = nlohmann::json::parse(settings);
  job.where = "jobs.jsonl:3";
  return render::readFrame(job, batchDefaults(), scene);
}

}  // namespace malus::test
