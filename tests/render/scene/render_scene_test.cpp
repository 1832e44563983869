#include "render/scene/render_scene.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "shaders/optics/optics.h"
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

TEST(RenderScene, NarrowSpotLightsHaveTheirIntensity) {
  for (const auto& [inner, outer] :
       {std::pair(1.0, 1.5), std::pair(5.0, 6.0), std::pair(0.0, 2.0), std::pair(0.1, 0.11)}) {
    pack::LightSource light;
    light.kind = pack::LightKind::spot;
    light.innerConeDegrees = inner;
    light.outerConeDegrees = outer;
    const pack::SpotFalloff falloff = pack::spotFalloff(light);
    EXPECT_NEAR(std::cos(inner * std::acos(-1.0) / 180) * falloff.scale + falloff.offset, 1, 1e-9) << inner;
    const double edge = std::cos(outer * std::acos(-1.0) / 180) * falloff.scale + falloff.offset;
    if (outer > 1) {
      EXPECT_NEAR(edge, 0, 1e-9) << outer;
    }
  }
}

TEST(RenderScene, FilmsAreThoseOfTheWavelengths) {
  // A film is the same at a wavelength and thickness that are both doubled.
  pack::Scene scene = test::emptyScene(1);
  pack::Material glass = test::dielectric(pack::MaterialKind::glass, 1.5);
  glass.coating = {glm::dvec3(1.38), 100};
  test::addMaterial(scene, glass);
  glass.coating.thicknessNm = 200;
  test::addMaterial(scene, glass);
  test::addSquare(scene, 0, {0, 0, 0}, {0, 0, 1}, 1);
  scene.wavelengthsNm = {600, 500, 400};
  const RenderScene once = makeRenderScene(scene);
  EXPECT_FLOAT_EQ(once.extras[0].roundTripPhase.x, 200.0f / 600);
  EXPECT_FLOAT_EQ(once.extras[0].roundTripPhase.z, 200.0f / 400);
  scene.wavelengthsNm *= 2;
  const RenderScene twice = makeRenderScene(scene);
  EXPECT_EQ(once.extras[0].roundTripPhase, twice.extras[1].roundTripPhase);
  EXPECT_EQ(once.materials[0].hemisphereTransmittance, twice.materials[1].hemisphereTransmittance);
  EXPECT_NE(once.materials[0].hemisphereTransmittance, twice.materials[0].hemisphereTransmittance);
}

TEST(RenderScene, CameraFieldOfViewIsVertical) {
  pack::Scene scene = test::emptyScene(1);
  scene.width = 200;
  scene.height = 100;
  scene.camera.verticalFovDegrees = 90;
  test::look(scene, {0.48, 0.92, 1.7}, {-0.15, 0.275, 0});
  RenderParameters parameters = defaultParameters(scene);
  parameters.samples = 3;
  const gpu::CameraParameters p = makeCameraParameters(scene, parameters);
  const pack::Camera& camera = scene.camera;
  for (const int column : {0, 1, 299, 300, 599})
    for (const int row : {0, 150, 299}) {
      const glm::dvec3 exact =
          f64::cameraDirection(camera.right, camera.up, camera.forward, 2, 1, (column + 0.5) / 600, (row + 0.5) / 300);
      const glm::vec3 got =
          f32::cameraSampleDirection(p.firstSample, p.firstSampleFine, p.columnStep, p.columnStepFine, p.rowStep,
                                     p.rowStepFine, static_cast<float>(column), static_cast<float>(row));
      // The angle between the two is the rounding of three components and no more.
      EXPECT_LT(glm::length(glm::cross(exact, glm::dvec3(got))), 1.2e-7) << column << ' ' << row;
    }
}

TEST(RenderScene, ContrastsAreOfDoublePrecision) {
  pack::Scene scene = test::emptyScene(1);
  pack::Material glass = test::dielectric(pack::MaterialKind::glass, 1.5000002);
  glass.outsideEta = 1.5;
  glass.coating.eta = glm::dvec3(1.5000003);
  glass.coating.thicknessNm = 100;
  test::addMaterial(scene, glass);
  const RenderScene rendered = makeRenderScene(scene);
  EXPECT_NEAR(rendered.materials[0].contrast.y, 2e-7, 1e-13);
  EXPECT_NEAR(rendered.extras[0].filmOverOutside.x, 3e-7, 1e-13);
  EXPECT_NEAR(rendered.extras[0].filmOverBase.z, 1e-7, 1e-13);
  EXPECT_NEAR(static_cast<double>(rendered.extras[0].filmEta.x) + static_cast<double>(rendered.extras[0].filmResidue.x),
              1.5000003, 1e-14);
}

TEST(RenderScene, SurfacesBetweenEqualMediaAreNotTraced) {
  pack::Scene scene = test::emptyScene(1);
  pack::Material glass = test::dielectric(pack::MaterialKind::glass, 1.5);
  glass.outsideEta = 1.5;
  const auto clear = test::addMaterial(scene, glass);
  glass.absorption = {0, 1, 0};
  const auto tinted = test::addMaterial(scene, glass);
  pack::Material paint = test::dielectric(pack::MaterialKind::paint, 1.5, 0.5);
  paint.outsideEta = 1.5;
  const auto opaque = test::addMaterial(scene, paint);
  for (const auto material : {clear, tinted, opaque}) test::addSquare(scene, material, {0, 0, 0}, {0, 0, 1}, 1);
  EXPECT_EQ(makeRenderScene(scene).meshTriangles, (std::vector<std::uint32_t>{0, 2, 2}));
}

}  // namespace
}  // namespace malus::render
