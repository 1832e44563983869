// Closed forms of the layers of materials on every renderer: specular factors, clear coats, tinted surfaces of glass.
#include <array>
#include <cmath>
#include <complex>
#include <initializer_list>

#include "tests/render/render_everywhere.h"
#include "tests/render/test_scene.h"
#include "tests/shaders/jones.h"

namespace malus {
namespace {

using oracle::Real;
using pack::Material;
using pack::MaterialKind;
using render::RenderParameters;
using render::RenderResult;
using test::middlePixel;
using test::renderEverywhere;
using test::Stokes;
using test::stokesAt;

// The middle pixel: its Stokes vector where a method has one, by single rays and by packets, else its colour.
void expectEverywhere(const pack::Scene& scene, std::size_t colour, const Stokes& truth, double tolerance) {
  std::map<std::string, RenderResult> results = renderEverywhere(scene);
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.stokes = true;
  parameters.embreePath = render::EmbreePath::packet;
  embree::Renderer embree(scene, 0);
  for (const char* method : {"stokes", "importance"})
    results[std::string("packets ") + method] = embree.render(method, parameters);
  for (const auto& [name, result] : results) {
    const Stokes s = stokesAt(result, middlePixel(result), colour);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(s[k], truth[k], tolerance) << name << ", S" << k;
  }
}

// The colour by the methods without Stokes vectors, for scenes of one polarizing interaction.
void expectColour(const pack::Scene& scene, std::size_t colour, double truth, double tolerance,
                  std::initializer_list<const char*> methods = {"fresnel", "fresnel-iterative", "sp"}) {
  const RenderParameters parameters = render::defaultParameters(scene);
  embree::Renderer embree(scene, 0);
  vulkan::Renderer vulkan(scene, {});
  for (const char* method : methods)
    EXPECT_NEAR(embree.render(method, parameters).pixels[colour], truth, tolerance) << "embree " << method;
  EXPECT_NEAR(vulkan.render("fresnel", parameters).pixels[colour], truth, tolerance);
}

// A floor that is met at an angle, in a white environment.
pack::Scene floorAt(double degrees, const Material& material, std::uint32_t depth = 1) {
  pack::Scene scene = test::emptyScene(depth);
  const double a = static_cast<double>(degrees * 3.14159265358979323846 / 180);
  test::look(scene, {3 * std::sin(a), 3 * std::cos(a), 0.013}, {0, 0, 0.013}, {0.2, 1, 0.7});
  scene.environment.radiance = glm::dvec3(1);
  test::addSquare(scene, test::addMaterial(scene, material), {0, 0, 0}, {0, 1, 0}, 1);
  return scene;
}

// S0 and |(S1, S2)| of white light after an interface; the camera's frame is turned, so that S1 and S2 mix.
void expectReflection(const pack::Scene& scene, std::size_t colour, double rs, double rp, double tolerance = 2e-6) {
  for (const auto& [name, result] : renderEverywhere(scene)) {
    const Stokes s = stokesAt(result, middlePixel(result), colour);
    EXPECT_NEAR(s[0], (rs + rp) / 2, tolerance) << name;
    EXPECT_NEAR(std::hypot(s[1], s[2]), std::abs(rs - rp) / 2, tolerance) << name;
    EXPECT_NEAR(s[3], 0, tolerance) << name;
  }
  expectColour(scene, colour, (rs + rp) / 2, tolerance);
}

oracle::Powers fresnel(double degrees, Real n1, oracle::Complex n2) {
  return oracle::powers(std::cos(static_cast<Real>(degrees) * 3.14159265358979323846L / 180), n1, n2);
}

TEST(MaterialLayers, SpecularFactorScalesTheReflectionAtEveryAngle) {
  for (const double degrees : {5.0, 80.0}) {
    SCOPED_TRACE(degrees);
    Material glass = test::dielectric(MaterialKind::mirrorGlass, 1.5);
    glass.specularFactor = 0.3;
    const oracle::Powers one = fresnel(degrees, 1, 1.5L);
    expectReflection(floorAt(degrees, glass), 0, double(0.3L * one.rs), double(0.3L * one.rp));
    Material metal = test::metal(glm::dvec3(0.2), glm::dvec3(3.4));
    metal.specularFactor = 0.3;
    const oracle::Powers gold = fresnel(degrees, 1, oracle::Complex(0.2L, -3.4L));
    expectReflection(floorAt(degrees, metal), 1, double(0.3L * gold.rs), double(0.3L * gold.rp));
  }
}

TEST(MaterialLayers, WhatIsNotReflectedEntersTheDiffuseLayer) {
  // A lamp above: albedo / pi x irradiance x T of its angle, and T of the view, both at normal incidence.
  for (const double factor : {1.0, 0.125}) {
    Material paint = test::dielectric(MaterialKind::paint, 1.5, 0.5);
    paint.specularFactor = factor;
    pack::Scene scene = floorAt(0.01, paint, 0);
    scene.environment.radiance = glm::dvec3(0);
    scene.lights.push_back({{0, 2, 0.013}, glm::dvec3(1)});
    const double t = 1 - 0.04 * factor, truth = 0.5 / 3.14159265358979323846 / 4 * t * t;
    expectEverywhere(scene, 0, {truth, 0, 0, 0}, 2e-7);
    expectColour(scene, 0, truth, 2e-7);
  }
}

TEST(MaterialLayers, SpecularFactorOfClearSurfacesKeepsEnergy) {
  for (const MaterialKind kind : {MaterialKind::glass, MaterialKind::thinGlass}) {
    Material glass = test::dielectric(kind, 1.5);
    glass.specularFactor = 0.4;
    pack::Scene scene = floorAt(60, glass, 24);
    test::addSquare(scene, 0, {0, -0.1, 0}, {0, -1, 0}, 1);
    for (pack::Mesh& mesh : scene.meshes) mesh.openSurface = true;
    expectEverywhere(scene, 0, {1, 0, 0, 0}, 2e-6);
  }
  // One interface: reflected black, transmitted white.
  Material glass = test::dielectric(MaterialKind::glass, 1.5);
  glass.specularFactor = 0.4;
  pack::Scene scene = floorAt(60, glass);
  scene.meshes[0].openSurface = true;
  scene.environment.radiance = glm::dvec3(0);
  test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(1))), {0, -1, 0}, {0, 1, 0}, 5);
  const oracle::Powers one = fresnel(60, 1, 1.5L);
  expectReflection(scene, 1, double(1 - 0.4L * one.rs), double(1 - 0.4L * one.rp));
  // Total reflection has no refracted ray, and stays total.
  scene.camera.mediumEta = 1.5;
  scene.materials[0].eta = glm::dvec3(1.0);
  scene.materials[0].outsideEta = 1.5;
  scene.meshes.resize(1);
  scene.environment.radiance = glm::dvec3(1);
  for (const auto& [name, result] : renderEverywhere(scene))
    EXPECT_NEAR(stokesAt(result, middlePixel(result), 0)[0], 2.25, 5e-6) << name;  // radiance in the medium
}

// Sum over the reflections inside a coat, of powers.
double coated(Real outer, Real base) {
  Real sum = outer, inside = (1 - outer) * (1 - outer) * base;
  for (int i = 0; i < 500; ++i, inside *= outer * base) sum += inside;
  return double(sum);
}

TEST(MaterialLayers, ClearCoatOnMetalAndPaint) {
  for (const double degrees : {5.0, 85.0})
    for (const double share : {1.0, 0.25}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, share " << share);
      const double inside =
          std::asin(std::sin(degrees * 3.14159265358979323846 / 180) / 1.5) / 3.14159265358979323846 * 180;
      const oracle::Powers outer = fresnel(degrees, 1, 1.5L);
      const auto expectCoat = [&](Material material, oracle::Complex index) {
        material.clearCoat = {1.5, share};
        const oracle::Powers bare = fresnel(degrees, 1, index), base = fresnel(inside, 1.5L, index);
        const auto mixed = [&](Real o, Real b, Real u) { return share * coated(o, b) + (1 - share) * double(u); };
        expectReflection(floorAt(degrees, material), 2, mixed(outer.rs, base.rs, bare.rs),
                         mixed(outer.rp, base.rp, bare.rp), 3e-6);
      };
      expectCoat(test::metal({0.2, 0.5, 1.3}, {3.4, 2.2, 1.9}), oracle::Complex(1.3L, -1.9L));
      expectCoat(test::dielectric(MaterialKind::mirrorGlass, 1.9), 1.9L);
    }
}

// Mueller terms of the reflection by a coat in vacuum: those of each path added.
struct Sum {
  double rs, rp, xRe, xIm;
};
Sum addPaths(Real c, Real coat, oracle::Complex index) {
  const oracle::Amplitudes enter = oracle::amplitudes(c, 1, coat),
                           leave = oracle::amplitudes(enter.cosT.real(), coat, 1),
                           base = oracle::amplitudes(enter.cosT.real(), coat, index);
  Real rs = 0, rp = 0;
  oracle::Complex x = 0;
  const auto add = [&](oracle::Complex s, oracle::Complex p) {
    rs += std::norm(s);
    rp += std::norm(p);
    x += p * std::conj(s);
  };
  add(enter.rs, enter.rp);
  oracle::Complex s = enter.ts, p = enter.tp;
  for (int i = 0; i < 500; ++i, s *= leave.rs, p *= leave.rp) {
    s *= base.rs;
    p *= base.rp;
    add(s * leave.ts, p * leave.tp);
  }
  return {double(rs), double(rp), double(x.real()), double(x.imag())};
}

TEST(MaterialLayers, CoatedMetalShiftsThePhaseOfPolarizedLight) {
  // A panel polarized at 45 degrees to the plane of incidence: S2 and S3 of the reflected light.
  Material gold = test::metal(glm::dvec3(0.2), glm::dvec3(3.4));
  gold.clearCoat = {1.5, 1};
  pack::Scene scene = floorAt(60, gold);
  scene.environment.radiance = glm::dvec3(0);
  Material panel = test::emitter(glm::dvec3(1));
  const double a = 3.14159265358979323846 / 3;
  panel.axis = glm::normalize(glm::dvec3(std::cos(a), std::sin(a), 1));
  panel.polarization = 1;
  test::addSquare(scene, test::addMaterial(scene, panel), {-2 * std::sin(a), 2 * std::cos(a), 0},
                  {std::sin(a), -std::cos(a), 0}, 1);
  const Sum coat = addPaths(std::cos(Real(a)), 1.5L, oracle::Complex(0.2L, -3.4L));
  for (const auto& [name, result] : renderEverywhere(scene)) {
    const Stokes s = stokesAt(result, middlePixel(result), 0);
    EXPECT_NEAR(s[0], (coat.rs + coat.rp) / 2, 2e-6) << name;
    EXPECT_NEAR(std::abs(s[3]), std::abs(coat.xIm), 2e-6) << name;
    EXPECT_NEAR(s[1] * s[1] + s[2] * s[2], std::pow((coat.rs - coat.rp) / 2, 2) + coat.xRe * coat.xRe, 5e-6) << name;
    EXPECT_LT(s[1] * s[1] + s[2] * s[2] + s[3] * s[3], 0.999 * s[0] * s[0]) << name << ": the sum depolarizes";
  }
}

TEST(MaterialLayers, ClearCoatOnGlassKeepsEnergyFromBothSides) {
  for (const double eta : {1.0, 1.9})
    for (const double share : {1.0, 0.5}) {
      SCOPED_TRACE(testing::Message() << "eta " << eta << ", share " << share);
      Material glass = test::dielectric(MaterialKind::glass, eta);
      glass.clearCoat = {1.5, share};
      pack::Scene scene = floorAt(70, glass, 40);
      test::addSquare(scene, 0, {0, -0.1, 0}, {0, -1, 0}, 30);
      for (pack::Mesh& mesh : scene.meshes) mesh.openSurface = true;
      expectEverywhere(scene, 0, {1, 0, 0, 0}, 5e-6);
    }
  // One interface, reflected. A coat of the index of the glass changes nothing.
  for (const double eta : {1.9, 1.5}) {
    Material glass = test::dielectric(MaterialKind::glass, eta);
    glass.clearCoat = {1.5, 1};
    pack::Scene scene = floorAt(60, glass);
    scene.meshes[0].openSurface = true;
    test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(0))), {0, -1, 0}, {0, 1, 0}, 5);
    const double inside = std::asin(std::sqrt(0.75) / 1.5) / 3.14159265358979323846 * 180;
    const oracle::Powers outer = fresnel(60, 1, 1.5L), base = fresnel(inside, 1.5L, Real(eta));
    expectReflection(scene, 0, coated(outer.rs, base.rs), coated(outer.rp, base.rp));
  }
}

TEST(MaterialLayers, TintedGlassColoursEachPassageThroughItsSurface) {
  Material glass = test::dielectric(MaterialKind::glass, 1.5);
  glass.transmittanceParallel = {0.5, 1, 0.25};
  glass.absorption = glm::dvec3(2);
  pack::Scene scene = floorAt(0.01, glass, 2);
  scene.environment.radiance = glm::dvec3(0);
  test::addSquare(scene, 0, {0, -0.5, 0}, {0, -1, 0}, 1);
  for (pack::Mesh& mesh : scene.meshes) mesh.openSurface = true;
  test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(1))), {0, -1, 0}, {0, 1, 0}, 1);
  const double clear = 0.96 * 0.96 * std::exp(-1.0);
  for (const auto& [colour, tint] : {std::pair(0, 0.5), {1, 1.0}, {2, 0.25}}) {
    expectEverywhere(scene, static_cast<std::size_t>(colour), {clear * tint * tint, 0, 0, 0}, 2e-6);
    // Not sp, whose |cos| rule creates energy between two surfaces.
    expectColour(scene, static_cast<std::size_t>(colour), clear * tint * tint, 2e-6, {"fresnel", "fresnel-iterative"});
  }
  // The reflection is not tinted.
  scene.meshes.pop_back();
  scene.meshes.pop_back();
  scene.environment.radiance = glm::dvec3(1);
  scene.depth = 1;
  test::addSquare(scene, 1, {0, -1, 0}, {0, 1, 0}, 1);
  scene.materials[1].radiance = glm::dvec3(0);
  expectEverywhere(scene, 2, {0.04, 0, 0, 0}, 2e-6);
}

}  // namespace
}  // namespace malus
