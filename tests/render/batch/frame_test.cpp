// Settings of frames, and errors that name the line and the key.
#include "render/batch/frame.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bake/materials/presets.h"
#include "meshprep/base/error.h"
#include "tests/render/batch/batch_scene.h"

namespace malus::render {
namespace {

using nlohmann::json;
using test::readFrame;

void expectError(const std::string& settings, const std::vector<std::string>& words,
                 pack::Scene scene = test::batchPack().scene) {
  try {
    readFrame(settings, scene);
    ADD_FAILURE() << settings;
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("jobs.jsonl:3: ")) << error.what();
    for (const std::string& word : words)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " / " << error.what();
  }
}

TEST(Frame, EmptyJobsHaveTheSettingsOfThePack) {
  const pack::Scene scene = test::batchPack().scene;
  const Frame frame = readFrame("{}", scene);
  EXPECT_EQ(frame.camera.position, scene.camera.position);
  EXPECT_EQ(frame.job.method, "stokes");
  EXPECT_EQ(frame.surfaces.materials.size(), scene.materials.size());
  EXPECT_EQ(frame.surfaces.lights.size(), 2u);
  EXPECT_EQ(frame.surfaces.wavelengthsNm, scene.wavelengthsNm);
  EXPECT_EQ(frame.surfaceKeys, json::object());
  EXPECT_EQ(frame.settings.at("width"), 24);
}

TEST(Frame, CamerasByPositionAndByPoseAreEqual) {
  const pack::Scene scene = test::batchPack().scene;
  const pack::Camera placed =
      readFrame(R"({"camera": {"position": [11, 2, 2], "target": [10, 0, -3], "up": [0.1, 1, 0]}})", scene).camera;
  EXPECT_LT(glm::length(placed.position - glm::dvec3(1, 2, 5)), 1e-14);  // relative to the scene's origin
  EXPECT_LT(glm::length(placed.forward - glm::normalize(glm::dvec3(-1, -2, -5))), 1e-14);
  EXPECT_EQ(placed.verticalFovDegrees, 60);
  json pose = json::array();
  for (int row = 0; row < 3; ++row)
    pose.push_back({placed.right[row], placed.up[row], -placed.forward[row], placed.position[row] + scene.origin[row]});
  const auto expectPlaced = [&](const json& matrix) {
    const pack::Camera posed = readFrame(json({{"camera", {{"pose", matrix}}}}).dump(), scene).camera;
    EXPECT_LT(glm::length(posed.position - placed.position), 1e-13);
    EXPECT_LT(glm::length(posed.right - placed.right), 1e-13);
    EXPECT_LT(glm::length(posed.up - placed.up), 1e-13);
    EXPECT_LT(glm::length(posed.forward - placed.forward), 1e-13);
  };
  expectPlaced(pose);
  pose.push_back({0, 0, 0, 1});
  expectPlaced(pose);
}

TEST(Frame, ProjectionsReplaceThatOfThePack) {
  const pack::Scene scene = test::batchPack().scene;
  // The intrinsics are in pixels of the frame.
  const pack::Camera shifted =
      readFrame(R"({"width": 100, "height": 80, "camera": {"intrinsics": {"fx": 90, "fy": 60, "cx": 40, "cy": 50}}})",
                scene)
          .camera;
  EXPECT_NEAR(shifted.verticalFovDegrees, 2 * std::atan(40.0 / 60) * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(shifted.pixelAspect, 60.0 / 90, 1e-15);
  EXPECT_NEAR(shifted.middleX, (50 - 40) * 60.0 / 90 / 80, 1e-15);
  EXPECT_NEAR(shifted.middleY, (50 - 40) / 80.0, 1e-15);
  EXPECT_EQ(readFrame(R"({"camera": {"orthographicHeight": 3}})", scene).camera.orthographicHeight, 3);
  pack::Scene orthographic = scene;
  orthographic.camera.orthographicHeight = 2;
  EXPECT_FALSE(readFrame(R"({"camera": {"verticalFovDegrees": 30}})", orthographic).camera.isOrthographic());
  EXPECT_TRUE(
      readFrame(R"({"camera": {"position": [0, 0, 0], "target": [0, 0, 1]}})", orthographic).camera.isOrthographic());
}

TEST(Frame, FiltersAndOutputsSetTheJob) {
  const pack::Scene scene = test::batchPack().scene;
  const Frame polarized = readFrame(R"({"polarizer": 90, "outputs": ["png", "dolp"], "exposure": -1})", scene);
  EXPECT_EQ(polarized.job.analyser, linearPolarizer(90));
  EXPECT_TRUE(polarized.job.needsLinear);
  EXPECT_FALSE(polarized.job.storesStokes);
  EXPECT_EQ(polarized.exposureEv, -1);
  EXPECT_EQ(readFrame(R"({"analyser": "left", "outputs": "exr"})", scene).job.analyser,
            circularAnalyser(Handedness::left));
  const Frame plate = readFrame(R"({"polarizer": 0, "wavePlate": {"axisDegrees": 45}})", scene);
  EXPECT_EQ(plate.job.analyser, behindWavePlate(linearPolarizer(0), {45, 90}));
  EXPECT_FALSE(readFrame(R"({"outputs": ["truth", "camera"]})", scene).outputs.needImage());
}

TEST(Frame, MaterialsTakeValues) {
  const pack::Scene scene = test::batchPack().scene;
  const std::vector<pack::Material> m =
      readFrame(R"({"materials": {"gold": {"eta": 0.5, "k": [1, 2, 3], "roughness": 0.3},
                                  "wall": {"albedo": [0.1, 0.2, 0.3], "coating": {"eta": 1.8, "thicknessNm": 120}},
                                  "pane": {"eta": 1.7, "transmittance": 0.5}, "lamp": {"radiance": [1, 0, 0]}}})",
                scene)
          .surfaces.materials;
  EXPECT_EQ(m[0].eta, glm::dvec3(0.5));
  EXPECT_EQ(m[0].k, glm::dvec3(1, 2, 3));
  EXPECT_EQ(m[0].roughness, 0.3);
  EXPECT_EQ(m[1].albedo, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(m[1].eta, scene.materials[1].eta);
  EXPECT_EQ(m[1].coating.thicknessNm, 120);
  EXPECT_EQ(m[1].coating.eta, glm::dvec3(1.8));
  EXPECT_EQ(m[2].transmittanceParallel, glm::dvec3(0.5));
  EXPECT_EQ(m[3].radiance, glm::dvec3(1, 0, 0));
}

TEST(Frame, LightsAndEnvironment) {
  const pack::Scene scene = test::batchPack().scene;
  EXPECT_TRUE(readFrame(R"({"lights": false})", scene).surfaces.lights.empty());
  EXPECT_EQ(readFrame(R"({"lights": true})", scene).surfaces.lights.size(), 2u);
  const Frame second = readFrame(R"({"lights": [false, true], "environment": {"rotationDegrees": 30}})", scene);
  ASSERT_EQ(second.surfaces.lights.size(), 1u);
  EXPECT_EQ(second.surfaces.lights[0].position, scene.lights[1].position);
  EXPECT_EQ(second.surfaces.environmentRotationDegrees, 30);
}

// At other wavelengths than the pack's, every index must be stated anew.
TEST(Frame, WavelengthsNeedConstants) {
  const pack::Scene scene = test::batchPack().scene;
  const std::string wavelengths = R"("wavelengthsNm": [700, 600, 500])";
  expectError("{" + wavelengths + "}", {"wavelengthsNm", "630", "'preset' or 'eta'"});
  expectError("{" + wavelengths + R"(, "materials": {"gold": {"preset": "gold"}, "wall": {"eta": 1.5}}})", {"'pane'"});
  const Frame frame = readFrame("{" + wavelengths +
                                    R"(, "materials": {"gold": {"preset": "gold"}, "wall": {"eta": 1.5},
                                                       "pane": {"preset": "bk7"}}})",
                                scene);
  EXPECT_EQ(frame.surfaces.wavelengthsNm, glm::dvec3(700, 600, 500));
  const bake::OpticalConstants gold = bake::requirePreset("gold").at(glm::dvec3(700, 600, 500));
  EXPECT_EQ(frame.surfaces.materials[0].eta, gold.eta);
  EXPECT_EQ(frame.surfaces.materials[0].k, gold.k);
  EXPECT_EQ(frame.surfaces.materials[2].k, glm::dvec3(0.0));
  // The pack's own wavelengths need nothing.
  EXPECT_NO_THROW(readFrame(R"({"wavelengthsNm": [630, 532, 465]})", scene));
}

TEST(Frame, ErrorsNameLineAndKey) {
  expectError(R"({"camra": {}})", {"camra", "'camera'"});
  expectError(R"({"camera": {"positoin": [0, 0, 0]}})", {"camera.", "positoin"});
  expectError(R"({"camera": {"position": [0, 0, 0]}})", {"camera.target", "missing"});
  expectError(R"({"camera": {"position": [0, 0, 0], "target": [0, 0, 0]}})", {"camera.target"});
  expectError(R"({"camera": {"position": [0, 0, 0], "target": [0, 1, 0]}})", {"camera.up", "parallel"});
  expectError(R"({"camera": {"pose": [[1, 0, 0, 0], [0, 1, 0, 0]]}})", {"camera.pose"});
  expectError(R"({"camera": {"pose": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}})", {"camera.pose", "orthonormal"});
  expectError(R"({"camera": {"pose": [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}})", {"camera.pose", "mirrors"});
  expectError(R"({"camera": {"pose": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]], "up": [0, 1, 0]}})", {"excludes"});
  expectError(R"({"camera": {"verticalFovDegrees": 20, "orthographicHeight": 2}})", {"camera", "projections"});
  expectError(R"({"camera": {"verticalFovDegrees": 200}})", {"camera.verticalFovDegrees", "179", "200"});
  expectError(R"({"camera": {"intrinsics": {"fx": 1, "fy": 1, "cx": 1}}})", {"camera.intrinsics.cy", "missing"});
  expectError(R"({"width": 0})", {"width", "1 to"});
  expectError(R"({"width": 10.5})", {"width", "whole"});
  expectError(R"({"method": "stoks"})", {"method", "'stokes'"});
  expectError(R"({"method": "fresnel", "outputs": ["dolp"]})", {"method", "'dolp'"});
  expectError(R"({"effects": "auto,magic"})", {"effects"});
  expectError(R"({"outputs": ["exr", "dlop"]})", {"outputs", "'dolp'"});
  expectError(R"({"outputs": []})", {"outputs"});
  expectError(R"({"polarizer": 0, "analyser": "left"})", {"analyser", "polarizer"});
  expectError(R"({"analyser": "up"})", {"analyser", "found up"});
  expectError(R"({"lights": [true]})", {"lights", "2"});
  expectError(R"({"lights": "off"})", {"lights"});
  expectError(R"({"environment": {"rotation": 3}})", {"environment.rotation", "'rotationDegrees'"});
}

TEST(Frame, MaterialErrorsNameTheKey) {
  expectError(R"({"materials": {"glod": {}}})", {"materials.glod", "'gold'"});
  expectError(R"({"materials": {"gold": {"rougness": 0.1}}})", {"materials.gold.rougness", "'roughness'"});
  expectError(R"({"materials": {"gold": {"roughness": 1.5}}})", {"materials.gold.roughness", "0 to 1", "1.5"});
  expectError(R"({"materials": {"gold": {"eta": 0, "k": 0}}})", {"materials.gold.eta"});
  expectError(R"({"materials": {"gold": {"eta": 1, "preset": "gold"}}})", {"materials.gold.preset"});
  expectError(R"({"materials": {"gold": {"preset": "godl"}}})", {"materials.gold.preset", "gold"});
  expectError(R"({"materials": {"gold": {"axis": [0, 0, 1]}}})", {"materials.gold.axis", "bake"});
  expectError(R"({"materials": {"wall": {"k": 1}}})", {"materials.wall.k"});
  expectError(R"({"materials": {"wall": {"preset": "gold"}}})", {"materials.wall.preset", "dielectric"});
  expectError(R"({"materials": {"pane": {"albedo": 1}}})", {"materials.pane.albedo"});
  expectError(R"({"materials": {"wall": {"coating": {"thicknessNm": 100}}}})", {"materials.wall.coating.eta"});
  expectError(R"({"materials": {"wall": {"coating": {"thicknessNm": 100, "eta": 1.4}, "clearCoat": {"factor": 1}}}})",
              {"materials.wall.clearCoat", "exclude"});
  expectError(R"({"materials": {"wall": {"coating": {"thickness": 100}}}})", {"materials.wall.coating.thickness"});
  // Constants in whose place the pack has a texture.
  pack::Scene mapped = test::batchPack().scene;
  mapped.textures.push_back({"t", 1, 1, {glm::vec3(0.5f)}});
  mapped.materials[0].meshMaps.roughness.texture = 0;
  mapped.materials[1].meshMaps.albedo.texture = 0;
  expectError(R"({"materials": {"gold": {"roughness": 0.1}}})", {"materials.gold.roughness", "texture"}, mapped);
  expectError(R"({"materials": {"wall": {"albedo": 0.1}}})", {"materials.wall.albedo", "texture"}, mapped);
}

}  // namespace
}  // namespace malus::render
