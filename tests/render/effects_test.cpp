// Closed forms of the effects that few scenes have, on every renderer: absorption, films, polarizing elements,
// displays, a clear sky, textures, rough surfaces.
#include <array>
#include <numbers>

#include "render/compare/image_error.h"
#include "tests/render/render_everywhere.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

using pack::Material;
using pack::MaterialKind;
using render::RenderParameters;
using render::RenderResult;
using test::renderEverywhere;
using test::Stokes;
using test::stokesAt;

// The middle pixel's Stokes vector on all of them.
void expectEverywhere(const pack::Scene& scene, std::size_t colour, const Stokes& truth, double tolerance) {
  for (const auto& [name, result] : renderEverywhere(scene)) {
    const Stokes s = stokesAt(result, result.pixels.size() / result.channels / 2, colour);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(s[k], truth[k], tolerance) << name << ", S" << k;
  }
}

// Looks along -z from z = 5.
pack::Scene along(std::uint32_t depth) {
  pack::Scene scene = test::emptyScene(depth);
  test::look(scene, {0.013, 0.017, 5}, {0.013, 0.017, 0});
  return scene;
}

Material sheet(MaterialKind kind, double axisDegrees) {
  Material m;
  m.name = "sheet";
  m.kind = kind;
  const double a = axisDegrees * std::numbers::pi / 180;
  m.axis = {std::cos(a), std::sin(a), 0};
  if (kind == MaterialKind::polarizer) m.transmittanceCrossed = glm::dvec3(0);
  if (kind == MaterialKind::wavePlate) m.retardanceDegrees = glm::dvec3(90);
  return m;
}

TEST(EffectClosedForms, MalusLaw) {
  // Polarizers at 0 and 30 degrees, the second the nearer: half of the light, then cos^2 30.
  pack::Scene scene = along(4);
  scene.environment.radiance = glm::dvec3(1);
  test::addSquare(scene, test::addMaterial(scene, sheet(MaterialKind::polarizer, 0)), {0, 0, 0}, {0, 0, 1}, 1);
  test::addSquare(scene, test::addMaterial(scene, sheet(MaterialKind::polarizer, 30)), {0, 0, 1}, {0, 0, 1}, 1);
  const double s0 = 0.5 * 0.75;
  expectEverywhere(scene, 0, {s0, s0 * 0.5, s0 * std::sqrt(0.75), 0}, 1e-6);
  // From behind they are the same sheets.
  for (pack::Mesh& mesh : scene.meshes)
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  expectEverywhere(scene, 0, {s0, s0 * 0.5, s0 * std::sqrt(0.75), 0}, 1e-6);
}

TEST(EffectClosedForms, QuarterWaveMakesCircularLight) {
  // Light along x through a plate whose fast axis is at +45 degrees: in the plate's frame it has S2 = -1, which
  // G turns into S3 = +1 (sin delta times -S2): right circular.
  pack::Scene scene = along(4);
  scene.environment.radiance = glm::dvec3(1);
  test::addSquare(scene, test::addMaterial(scene, sheet(MaterialKind::polarizer, 0)), {0, 0, 0}, {0, 0, 1}, 1);
  const std::uint32_t plate = test::addMaterial(scene, sheet(MaterialKind::wavePlate, 45));
  test::addSquare(scene, plate, {0, 0, 1}, {0, 0, 1}, 1);
  expectEverywhere(scene, 1, {0.5, 0, 0, 0.5}, 1e-6);
  scene.materials[plate].retardanceDegrees = glm::dvec3(180);  // a half wave turns it to the y axis
  expectEverywhere(scene, 1, {0.5, -0.5, 0, 0}, 1e-6);
  // As the plate in front of a camera's filter (render_parameters.h), a third implementation: behind a quarter wave and
  // a linear filter at 0, light from +45 degrees.
  pack::Scene bare = along(4);
  Material panel = test::emitter(glm::dvec3(1));
  panel.axis = glm::normalize(glm::dvec3(1, 1, 0));
  panel.polarization = 1;
  test::addSquare(bare, test::addMaterial(bare, panel), {0, 0, -1}, {0, 0, 1}, 1);
  pack::Scene withPlate = bare;
  test::addSquare(withPlate, test::addMaterial(withPlate, sheet(MaterialKind::wavePlate, 20)), {0, 0, 1}, {0, 0, 1}, 1);
  RenderParameters parameters = render::defaultParameters(bare);
  parameters.analyser = render::behindWavePlate(render::linearPolarizer(70), {20, 90});
  const double filtered = reference::render(bare, parameters, 0).pixels[0];
  parameters.analyser = render::linearPolarizer(70);
  EXPECT_NEAR(reference::render(withPlate, parameters, 0).pixels[0], filtered, 1e-6);
}

TEST(EffectClosedForms, DisplayIsSeenAtItsAngleAndDegree) {
  pack::Scene scene = along(2);
  Material panel = test::emitter({3, 2, 1});
  panel.axis = {std::cos(0.3), std::sin(0.3), 0};
  panel.polarization = 0.75;
  test::addSquare(scene, test::addMaterial(scene, panel), {0, 0, 0}, {0, 0, 1}, 1);
  expectEverywhere(scene, 0, {3, 3 * 0.75 * std::cos(0.6), 3 * 0.75 * std::sin(0.6), 0}, 2e-6);
  // At an oblique angle the field is perpendicular to the absorbing axis: that of a panel turned about its own field
  // does not move.
  test::look(scene, {4, 0, 4}, {0, 0, 0});
  scene.materials[0].axis = {1, 0, 0};
  expectEverywhere(scene, 0, {3, 3 * 0.75, 0, 0}, 2e-6);
}

TEST(EffectClosedForms, DisplayVanishesInAGlassTableAtBrewstersAngle) {
  const double brewster = std::atan(1.5), s = std::sin(brewster), c = std::cos(brewster);
  const auto image = [&](const glm::dvec3& axis) {
    pack::Scene scene = test::emptyScene(1);
    test::look(scene, {0, 3 * c, 3 * s}, {0, 0, 0});
    test::addSquare(scene, test::addMaterial(scene, test::dielectric(MaterialKind::mirrorGlass, 1.5)), {0, 0, 0},
                    {0, 1, 0}, 1);
    Material panel = test::emitter(glm::dvec3(1));
    panel.axis = axis;
    panel.polarization = 1;
    test::addSquare(scene, test::addMaterial(scene, panel), {0, 3 * c, -3 * s}, {0, -c, s}, 0.5);
    return scene;
  };
  const double rs = std::pow((1 - 1.5 * 1.5) / (1 + 1.5 * 1.5), 2);
  expectEverywhere(image({1, 0, 0}), 0, {rs, rs, 0, 0}, 1e-6);          // field along the table
  expectEverywhere(image({0, s, c}), 0, {0, 0, 0, 0}, 1e-6);            // field in the plane of incidence
  expectEverywhere(image({1, s, c}), 0, {rs / 2, rs / 2, 0, 0}, 2e-6);  // half and half
}

TEST(EffectClosedForms, SkyIsPolarizedAcrossTheSun) {
  pack::Scene scene = along(0);
  test::addSquare(scene, test::addMaterial(scene, {}), {0, 0, 100}, {0, 0, -1}, 1);  // behind the camera
  scene.environment.radiance = {1, 2, 4};
  scene.environment.skyDegree = 0.8;
  // The sun to the right, at 90 degrees: the field is upright (S1 < 0); phase 3/4.
  scene.environment.sun = {1, 0, 0};
  expectEverywhere(scene, 2, {3, -3 * 0.8, 0, 0}, 3e-6);
  // 60 degrees from the view, in the direction of +45 degrees of the image: field at 135.
  scene.environment.sun = {std::sin(std::numbers::pi / 3) * std::sqrt(0.5),
                           std::sin(std::numbers::pi / 3) * std::sqrt(0.5), -0.5};
  const double phase = 0.75 * 1.25, degree = 0.8 * 0.75 / 1.25;
  expectEverywhere(scene, 0, {phase, 0, -phase * degree, 0}, 2e-6);
  // Into the sun it is not polarized.
  scene.environment.sun = {0, 0, -1};
  expectEverywhere(scene, 0, {1.5, 0, 0, 0}, 2e-6);
}

TEST(EffectClosedForms, GlassTakesWhatBeerAndLambertSay) {
  // A thick plate at normal incidence, lit from behind; depth 2 leaves the straight way alone.
  pack::Scene scene = along(2);
  Material glass = test::dielectric(MaterialKind::glass, 1.5);
  glass.absorption = {0, 1, 10};
  const std::uint32_t material = test::addMaterial(scene, glass);
  test::addSquare(scene, material, {0, 0, 1}, {0, 0, 1}, 1);
  test::addSquare(scene, material, {0, 0, 0.75}, {0, 0, -1}, 1);
  scene.meshes[0].openSurface = scene.meshes[1].openSurface = true;
  test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(1))), {0, 0, 0}, {0, 0, 1}, 1);
  const double t = 0.96 * 0.96;
  expectEverywhere(scene, 0, {t, 0, 0, 0}, 2e-6);
  expectEverywhere(scene, 1, {t * std::exp(-0.25), 0, 0, 0}, 2e-6);
  expectEverywhere(scene, 2, {t * std::exp(-2.5), 0, 0, 0}, 2e-6);
  // The medium outside: 4 m from the camera to the plate, 0.75 m behind it.
  scene.materials[0].absorption = glm::dvec3(0);
  scene.materials[0].outsideAbsorption = scene.materials[1].outsideAbsorption = glm::dvec3(0.1);
  expectEverywhere(scene, 0, {t * std::exp(-0.475), 0, 0, 0}, 2e-6);
}

// A pane of 2 mm whose absorption takes 1 - 1/e of the light along its normal n, met at an angle, in front of a panel.
// lift: of the pane along n over the scene's origin.
constexpr double kPaneThickness = 2e-3;
pack::Scene largePane(double size, double degrees, double lift, const glm::dvec3& n) {
  pack::Scene scene = test::emptyScene(2);  // the straight way alone
  Material glass = test::dielectric(MaterialKind::glass, 1.5);
  glass.absorption = glm::dvec3(1 / kPaneThickness);
  const std::uint32_t material = test::addMaterial(scene, glass);
  const glm::dvec3 foot = n * lift;
  test::addSquare(scene, material, foot + n * (kPaneThickness / 2), n, size / 2);
  test::addSquare(scene, material, foot - n * (kPaneThickness / 2), -n, size / 2);
  test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(1))), foot - n * 0.05, n, size / 2);
  for (pack::Mesh& mesh : scene.meshes) {
    mesh.openSurface = true;
    mesh.origin = glm::dvec3(glm::vec3(foot));  // as in a pack
  }
  const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(0.3, 0.8, -0.5), n));
  const double a = degrees * std::numbers::pi / 180;
  const glm::dvec3 at = foot + across * (0.11 * size) + glm::cross(n, across) * (0.07 * size);
  test::look(scene, at + n * std::cos(a) + across * std::sin(a), at, {0.1, 0.6, 0.8});
  return scene;
}

// Power transmitted by both faces and the medium, without internal reflections.
double paneTransmittance(double degrees) {
  const double sine = std::sin(degrees * std::numbers::pi / 180), c = std::sqrt(1 - sine * sine),
               t = std::sqrt(1 - sine * sine / 2.25), rs = std::pow((c - 1.5 * t) / (c + 1.5 * t), 2),
               rp = std::pow((1.5 * c - t) / (1.5 * c + t), 2);
  return (std::pow(1 - rs, 2) + std::pow(1 - rp, 2)) / 2 * std::exp(-1 / t);
}

TEST(EffectClosedForms, AbsorptionOfLargeThinPanes) {
  for (const double size : {2.0, 200.0, 2000.0})
    for (const double degrees : {0.0, 60.0})
      for (const double lift : {0.0, 500.0}) {
        SCOPED_TRACE(testing::Message() << size << " m, " << degrees << " degrees, lifted by " << lift << " m");
        const pack::Scene scene = largePane(size, degrees, lift, {0, 0, 1});
        std::map<std::string, RenderResult> results = renderEverywhere(scene);
        RenderParameters parameters = render::defaultParameters(scene);
        parameters.stokes = true;
        parameters.embreePath = render::EmbreePath::packet;
        for (const char* method : {"stokes", "stokes-half", "importance"})
          results[std::string("packets ") + method] = embree::Renderer(scene, 0).render(method, parameters);
        const double expected = paneTransmittance(degrees);
        for (const auto& [name, result] : results)
          EXPECT_NEAR(stokesAt(result, 0, 1)[0] / expected, 1, name.find("half") == std::string::npos ? 1e-4 : 3e-3)
              << name;
      }
}

// A pane met at 60 degrees, between an environment and a panel: as thin glass, or as the two faces of a slab.
pack::Scene obliquePane(bool isThin, double transmittance, bool isPolarized) {
  pack::Scene scene = test::emptyScene(24);
  const double half = std::sqrt(0.75), thickness = 0.1;
  test::look(scene, {4 * half, 0.013, 2}, {0, 0.013, 0});
  scene.environment.radiance = {0.2, 0.4, 0.8};
  Material pane = test::dielectric(isThin ? MaterialKind::thinGlass : MaterialKind::glass, 1.5);
  if (isThin) pane.transmittanceParallel = glm::dvec3(transmittance);
  if (!isThin) pane.absorption = glm::dvec3(-std::log(transmittance) / thickness);
  const std::uint32_t material = test::addMaterial(scene, pane);
  test::addSquare(scene, material, {0, 0, 0}, {0, 0, 1}, 3);
  if (!isThin) test::addSquare(scene, material, {0, 0, -thickness}, {0, 0, -1}, 3);
  for (pack::Mesh& mesh : scene.meshes) mesh.openSurface = true;
  if (isPolarized) {
    Material polarizer = sheet(MaterialKind::polarizer, 40);
    test::addSquare(scene, test::addMaterial(scene, polarizer), {0, 0, -0.5}, {0, 0, 1}, 20);
  }
  test::addSquare(scene, test::addMaterial(scene, test::emitter({3, 2, 1})), {0, 0, -1}, {0, 0, 1}, 40);
  return scene;
}

TEST(EffectClosedForms, ThinGlassSumsInternalReflections) {
  // One interface at 60 degrees, n = 1.5, without absorption: T' = T/(2 - T), R' = 1 - T'. s is the image's y axis.
  const double c = 0.5, t = std::sqrt(1.5 * 1.5 - 0.75), rs = std::pow((c - t) / (c + t), 2),
               rp = std::pow((2.25 * c - t) / (2.25 * c + t), 2);
  const double ts = (1 - rs) / (1 + rs), tp = (1 - rp) / (1 + rp);
  const auto expected = [&](double behind, double front) {
    return Stokes{(behind * (ts + tp) + front * (2 - ts - tp)) / 2, (behind - front) * (tp - ts) / 2, 0, 0};
  };
  const pack::Scene scene = obliquePane(true, 1, false);
  expectEverywhere(scene, 0, expected(3, 0.2), 3e-6);
  expectEverywhere(scene, 2, expected(1, 0.8), 3e-6);
}

TEST(EffectClosedForms, ThinGlassEqualsARenderedSlab) {
  const auto thin = renderEverywhere(obliquePane(true, 0.9, true)),
             slab = renderEverywhere(obliquePane(false, 0.9, true));
  for (const auto& [name, result] : thin) {
    const std::size_t middle = result.pixels.size() / result.channels / 2;
    for (std::size_t colour = 0; colour < 3; ++colour) {
      const Stokes a = stokesAt(result, middle, colour), b = stokesAt(slab.at(name), middle, colour);
      EXPECT_GT(std::abs(b[2]), 0.05 * b[0]) << "the light is polarized at an angle";
      for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(a[k], b[k], 2e-5) << name << ", S" << k;
    }
  }
}

TEST(EffectClosedForms, QuarterWaveCoatingTakesTheReflectionAway) {
  // An index of sqrt(1.5) and a quarter of the green wavelength: nothing of it is reflected, all of it goes through.
  pack::Scene scene = along(1);
  scene.environment.radiance = glm::dvec3(1);
  Material coated = test::dielectric(MaterialKind::mirrorGlass, 1.5);
  coated.coating = {glm::dvec3(std::sqrt(1.5)), 532 / (4 * std::sqrt(1.5))};
  test::addSquare(scene, test::addMaterial(scene, coated), {0, 0, 0}, {0, 0, 1}, 1);
  expectEverywhere(scene, 1, {0, 0, 0, 0}, 1e-6);
  // At another wavelength: Airy's formula for one angle, R = 4 r^2 cos^2(beta)/(1 + 2 r^2 cos(2 beta) + r^4).
  const double n = std::sqrt(1.5), r2 = std::pow((n - 1) / (n + 1), 2), beta = std::numbers::pi / 2 * 532 / 465;
  expectEverywhere(scene, 2,
                   {4 * r2 * std::pow(std::cos(beta), 2) / (1 + 2 * r2 * std::cos(2 * beta) + r2 * r2), 0, 0, 0}, 1e-6);
  // Through a coated pane, both faces coated: all of it.
  pack::Scene pane = along(2);
  coated.kind = MaterialKind::glass;
  const std::uint32_t glass = test::addMaterial(pane, coated);
  test::addSquare(pane, glass, {0, 0, 1}, {0, 0, 1}, 1);
  test::addSquare(pane, glass, {0, 0, 0.75}, {0, 0, -1}, 1);
  test::addSquare(pane, test::addMaterial(pane, test::emitter(glm::dvec3(1))), {0, 0, 0}, {0, 0, 1}, 1);
  expectEverywhere(pane, 1, {1, 0, 0, 0}, 2e-6);
}

TEST(EffectClosedForms, TexturesEqualTheirImages) {
  pack::Scene scene = along(0);
  scene.environment.radiance = glm::dvec3(1);
  scene.environment.ambientIrradiance = 1;
  scene.environment.irradiance[0] = glm::dvec3(std::numbers::pi);
  Material wall;
  wall.albedo = {1, 0.5, 1};
  wall.maps = {0, -1, -1, {-1, 1, 0}, {0.5, 0, 0}, {0, -0.5, 0}};  // the square, its upper left corner first
  scene.textures = {{"", 2, 2, {{0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}, {0.7f, 0.8f, 0.9f}, {1, 0, 0.25f}}}};
  test::addSquare(scene, test::addMaterial(scene, wall), {0, 0, 0}, {0, 0, 1}, 1);
  const auto lookAt = [&](double x, double y) { test::look(scene, {x, y, 5}, {x, y, 0}); };
  lookAt(-0.5, 0.5);
  expectEverywhere(scene, 0, {0.1, 0, 0, 0}, 2e-6);
  expectEverywhere(scene, 1, {0.1, 0, 0, 0}, 2e-6);
  lookAt(0.5, 0.5);
  expectEverywhere(scene, 2, {0.6, 0, 0, 0}, 2e-6);
  lookAt(-0.5, -0.5);
  expectEverywhere(scene, 0, {0.7, 0, 0, 0}, 2e-6);
  lookAt(0.013, 0.5);  // half way: bilinear
  expectEverywhere(scene, 0, {0.25 + 0.013 * 0.3, 0, 0, 0}, 2e-6);
  // A map of the index: Fresnel at normal incidence.
  scene.depth = 1;
  scene.materials[0] = test::dielectric(MaterialKind::mirrorGlass, 1.5);
  scene.materials[0].maps = {-1, 0, -1, {-1, 1, 0}, {0.5, 0, 0}, {0, -0.5, 0}};
  for (glm::vec3& t : scene.textures[0].texels) t = glm::vec3(1.5f);
  scene.textures[0].texels[1] = glm::vec3(2);
  lookAt(0.5, 0.5);
  expectEverywhere(scene, 0, {1.0 / 9, 0, 0, 0}, 1e-6);
  lookAt(-0.5, 0.5);
  expectEverywhere(scene, 0, {0.04, 0, 0, 0}, 1e-6);
}

TEST(EffectClosedForms, RoughMirrorsKeepWhatTheyReflect) {
  // In uniform light a mirror that reflects all gives back what its facets do not hide from each other: 0.8273 by the
  // integral over directions (facets_test.cpp), 16 facets within 1 %.
  pack::Scene scene = test::emptyScene(1);
  test::look(scene, {0, 2, 3}, {0, 0, 0});
  scene.environment.radiance = glm::dvec3(1);
  Material mirror = test::metal(glm::dvec3(1e-3), glm::dvec3(1e3));
  mirror.roughness = 0.3;
  test::addSquare(scene, test::addMaterial(scene, mirror), {0, 0, 0}, {0, 1, 0}, 1);
  const Stokes rough = stokesAt(reference::render(scene, render::defaultParameters(scene), 0), 0, 0);
  EXPECT_NEAR(rough[0], 0.8273, 0.01);
  expectEverywhere(scene, 0, rough, 3e-6);
  // A nearly smooth one is the smooth one, its polarization too.
  scene.materials[0] = test::dielectric(MaterialKind::mirrorGlass, 1.5);
  const Stokes smooth = stokesAt(reference::render(scene, render::defaultParameters(scene), 0), 0, 0);
  scene.materials[0].roughness = 1e-4;
  expectEverywhere(scene, 0, smooth, 2e-5);
  // A rough one is less polarized.
  scene.materials[0].roughness = 0.5;
  const Stokes dull = stokesAt(reference::render(scene, render::defaultParameters(scene), 0), 0, 0);
  EXPECT_LT(dull[1] / dull[0], 0.95 * smooth[1] / smooth[0]);
  expectEverywhere(scene, 0, dull, 3e-6);
}

}  // namespace
}  // namespace malus
