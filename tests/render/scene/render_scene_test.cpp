#include "render/scene/render_scene.h"

#include <gtest/gtest.h>

#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

TEST(RenderScene, KeepsTheMeshesApart) {
  pack::Scene scene = test::emptyScene(1);
  const auto glass = test::addMaterial(scene, test::dielectric(pack::MaterialKind::mirrorGlass, 1.5));
  const auto gold = test::addMaterial(scene, test::metal({0.2, 0.5, 1.3}, {3, 2, 2}));
  test::addSquare(scene, glass, {0, 0, 0}, {0, 0, 1}, 1);
  test::addSquare(scene, gold, {0, 0, 1}, {0, 0, 1}, 1);
  scene.meshes[1].normals.assign(4, glm::vec3(0, 0, 1));
  const RenderScene floats = makeRenderScene(scene);
  ASSERT_EQ(floats.meshes.size(), 2u);
  EXPECT_EQ(floats.meshes[1].firstTriangle, 2u);
  EXPECT_EQ(floats.meshes[1].firstVertex, 4u);
  EXPECT_EQ(floats.meshes[0].hasNormals, 0u);
  EXPECT_EQ(floats.meshes[1].hasNormals, 1u);
  EXPECT_EQ(floats.materials[glass].kind, gpu::kPaint);
  EXPECT_EQ(floats.materials[gold].kind, gpu::kMetal);
  EXPECT_EQ(floats.normals.size(), floats.positions.size());
}

TEST(RenderScene, EmittersInsideGlassGiveBasicRadiance) {
  pack::Scene scene = test::emptyScene(1);
  pack::Material lamp = test::emitter({9, 9, 9});
  lamp.outsideEta = 1.5;
  test::addMaterial(scene, lamp);
  test::addSquare(scene, 0, {0, 0, 0}, {0, 0, 1}, 1);
  EXPECT_FLOAT_EQ(makeRenderScene(scene).materials[0].radiance.x, 4.0f);
}

TEST(RenderScene, HemisphereTransmittanceOfGlass) {
  // 1 - 0.0918 for n = 1.5: the diffuse reflectance of an interface from outside, twice the integral over the cosine c
  // of c times the mean of R_s and R_p, by numerical quadrature.
  const glm::dvec3 t = hemisphereTransmittance(test::dielectric(pack::MaterialKind::paint, 1.5, 1));
  EXPECT_NEAR(t.x, 1 - 0.0918, 2e-4);
  EXPECT_NEAR(hemisphereTransmittance(test::dielectric(pack::MaterialKind::paint, 1.0, 1)).y, 1, 1e-12);
}

TEST(RenderScene, CameraFieldOfViewIsVertical) {
  pack::Scene scene = test::emptyScene(1);
  scene.width = 200;
  scene.height = 100;
  scene.camera.verticalFovDegrees = 90;
  const gpu::CameraParameters frame = makeCameraParameters(scene, defaultParameters(scene));
  EXPECT_FLOAT_EQ(frame.tanY, 1.0f);
  EXPECT_FLOAT_EQ(frame.tanX, 2.0f);
}

}  // namespace
}  // namespace malus::render
