// Point lights close to large faces. Distance and direction are those of the hit and not of the point from which the
// shadow ray starts, which is off the face by a distance that grows with the triangle. In the reference and on both
// renderers, against I cos / d^2; index contrasts that float does not resolve against Fresnel's equations.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/vulkan/renderer.h"
#include "tests/render/test_scene.h"

namespace malus::test {
namespace {

struct Value {
  std::string renderer;
  double green;
};
std::array<Value, 3> centres(const pack::Scene& scene, const std::string& method) {
  const render::RenderParameters parameters = render::defaultParameters(scene);
  const auto green = [](const render::RenderResult& r) { return static_cast<double>(r.pixels[1]); };
  return {Value{"reference", green(reference::render(scene, parameters, 0))},
          Value{"embree", green(embree::Renderer(scene, 0).render(method, parameters))},
          Value{"vulkan", green(vulkan::Renderer(scene, {}).render(method, parameters))}};
}
void expectCentres(const pack::Scene& scene, const std::string& method, double want, double relative) {
  for (const Value& v : centres(scene, method)) EXPECT_NEAR(v.green, want, relative * want) << v.renderer;
}

pack::Material lambert(double albedo) {
  pack::Material m;
  m.name = "lambert";
  m.kind = pack::MaterialKind::lambert;
  m.albedo = glm::dvec3(albedo);
  return m;
}

// Square plate in the plane y = level, seen from above at a slant; lamp at a height above the point (x, 0) of it while
// the camera sees the origin.
pack::Scene plateUnderLamp(const pack::Material& material, double half, double level, double height, double x) {
  pack::Scene scene = emptyScene(4);
  look(scene, {-1, level + 1.7, 0.3}, {0, level, 0});
  addSquare(scene, addMaterial(scene, material), {0, level, 0}, {0, 1, 0}, half);
  const double distanceSq = x * x + height * height, intensity = distanceSq * std::sqrt(distanceSq) / height;
  scene.lights.push_back({{x, level + height, 0}, glm::dvec3(intensity)});  // irradiance 1 at the origin
  return scene;
}

TEST(Lamps, CloseToLargeDiffuseFaces) {
  for (const auto& [half, height] :
       {std::pair(5000.0, 0.3), {5000.0, 0.1}, {5000.0, 1e-3}, {4.0, 1e-3}, {4.0, 1e-4}, {4.0, 1e-6}})
    for (const std::string method : {"fresnel", "importance"}) {
      SCOPED_TRACE(testing::Message() << half << " m, lamp at " << height << " m, " << method);
      expectCentres(plateUnderLamp(lambert(0.5), half, 0, height, 0), method, 0.5 / std::numbers::pi, 1e-5);
    }
}

TEST(Lamps, BesideTheHit) {
  for (const double half : {5000.0, 4.0})
    for (const double x : {0.05, 0.3}) {
      SCOPED_TRACE(testing::Message() << half << " m, lamp beside by " << x << " m");
      expectCentres(plateUnderLamp(lambert(0.5), half, 0, 0.3, x), "fresnel", 0.5 / std::numbers::pi, 1e-5);
    }
}

TEST(Lamps, OnAFaceAtAHeight) {
  // The lamp's height over the face is representable.
  expectCentres(plateUnderLamp(lambert(0.5), 64, 2, 1.0 / 1024, 0), "fresnel", 0.5 / std::numbers::pi, 1e-5);
}

TEST(Lamps, ShadowsOfSmallObstaclesRemain) {
  for (const double half : {5000.0, 4.0})
    for (const double height : {0.3, 1e-3}) {
      SCOPED_TRACE(testing::Message() << half << " m, lamp at " << height << " m");
      pack::Scene scene = plateUnderLamp(lambert(0.5), half, 0, height, 0);
      if (half > 100 && height < 0.1) continue;  // within the rounding error of a triangle of 10 km
      // A small plate between the lamp and the ground, and one above the lamp, which blocks nothing.
      addSquare(scene, 0, {0, height * 1.25, 0}, {0, 1, 0}, height / 8);
      expectCentres(scene, "fresnel", 0.5 / std::numbers::pi, 1e-5);
      addSquare(scene, 0, {0, height / 2, 0}, {0, 1, 0}, height / 8);
      for (const Value& v : centres(scene, "fresnel")) EXPECT_EQ(v.green, 0) << v.renderer;
    }
}

TEST(Lamps, HighlightAndBaseOfPaint) {
  // Paint of the index of its medium is the bare diffuse surface.
  pack::Material paint = dielectric(pack::MaterialKind::paint, 1.5, 0.5);
  paint.outsideEta = 1.5;
  pack::Scene scene = plateUnderLamp(paint, 4, 0, 1e-3, 0);
  scene.camera.mediumEta = 1.5;
  expectCentres(scene, "fresnel", 0.5 / std::numbers::pi, 1e-5);
}

// R of a plane of glass against a medium, where the reflected ray sees an emitter of radiance 1 over R.
pack::Scene mirrorScene(const pack::Material& material, double cosine) {
  pack::Scene scene = emptyScene(1);
  const double sine = std::sqrt(1 - cosine * cosine);
  look(scene, {-sine * 2, cosine * 2, 0}, {0, 0, 0}, {0, 0, 1});
  addSquare(scene, addMaterial(scene, material), {0, 0, 0}, {0, 1, 0}, 0.5);
  scene.camera.mediumEta = material.outsideEta;
  pack::Material lamp = emitter(glm::dvec3(1e6));
  lamp.outsideEta = material.outsideEta;
  addSquare(scene, addMaterial(scene, lamp), {sine * 2, cosine * 2, 0}, {-sine, -cosine, 0}, 0.015);
  return scene;
}

TEST(Contrasts, InterfacesInMedia) {
  for (const double outside : {1.5, 1.33})
    for (const double contrast : {1e-6, 2e-7, -1e-6}) {
      const double c = 0.5, n2 = outside + contrast;
      // r_s and r_p in long double, from the contrast.
      const long double e = contrast * (2.0L * outside + contrast) / (outside * outside),
                        t = std::sqrt(e + static_cast<long double>(c) * c), rs = e / ((c + t) * (c + t)),
                        rho = (1 - c * c - c * t) / (1 - c * c + c * t), mean = rs * rs * (1 + rho * rho) / 2;
      for (const pack::MaterialKind kind : {pack::MaterialKind::mirrorGlass, pack::MaterialKind::glass}) {
        pack::Material m = dielectric(kind, n2);
        m.outsideEta = outside;
        SCOPED_TRACE(testing::Message() << outside << " + " << contrast << ", kind " << static_cast<int>(kind));
        expectCentres(mirrorScene(m, c), "fresnel", static_cast<double>(mean) * 1e6, 1e-5);
      }
    }
}

// Rays pass a surface between equal media unchanged, whatever the method makes of polarized light, and its shadow is
// none.
TEST(Contrasts, SurfacesBetweenEqualMediaAreInvisible) {
  pack::Material glass = dielectric(pack::MaterialKind::glass, 1.33);
  glass.outsideEta = 1.33;
  pack::Material pane = dielectric(pack::MaterialKind::thinGlass, 1.33);
  pane.outsideEta = 1.33;
  for (const pack::Material& m : {glass, pane}) {
    pack::Scene scene = plateUnderLamp(lambert(0.5), 4, 0, 0.3, 0);
    const std::uint32_t clear = addMaterial(scene, m);
    addSquare(scene, clear, {-0.5, 0.85, 0.15}, {0.3, 1, 0.2}, 0.2);  // in front of the camera
    addSquare(scene, clear, {0, 0.1, 0}, {0.2, 1, 0}, 0.2);           // and of the lamp
    scene.depth = 0;
    for (const char* method : {"sp", "importance"}) expectCentres(scene, method, 0.5 / std::numbers::pi, 1e-5);
    // With a contrast, or with absorption, it is a surface.
    scene.materials[clear].eta = glm::dvec3(1.4);
    for (const Value& v : centres(scene, "fresnel")) EXPECT_EQ(v.green, 0) << v.renderer;
    scene.materials[clear].eta = glm::dvec3(1.33);
    scene.materials[clear].absorption = glm::dvec3(1);
    scene.materials[clear].transmittanceParallel = glm::dvec3(0.5);
    for (const Value& v : centres(scene, "fresnel")) EXPECT_EQ(v.green, 0) << v.renderer;
  }
}

TEST(Contrasts, MatchedGlassReflectsNothingBySchlick) {
  for (const double cosine : {1.0, 0.5, 0.01}) {
    pack::Scene scene = mirrorScene(dielectric(pack::MaterialKind::glass, 1), cosine);
    for (const char* method : {"schlick", "schlick-iterative", "fresnel"})
      for (const Value& v : centres(scene, method)) EXPECT_EQ(v.green, 0) << v.renderer << ' ' << method;
  }
}

}  // namespace
}  // namespace malus::test
