// Closed forms of area lights, of environments that illuminate, and of lights behind thin surfaces, on every renderer.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "render/scene/area_lights.h"
#include "shaders/optics/optics.h"
#include "tests/render/render_everywhere.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

using glm::dvec3;
using pack::Material;
using pack::MaterialKind;
using render::RenderParameters;
using render::RenderResult;
using test::addMaterial;
using test::addSquare;

constexpr double kPi = std::numbers::pi, kAlbedo = 0.6, kDegree = kPi / 180;

Material lambert() {
  Material m;
  m.name = "floor";
  m.albedo = dvec3(kAlbedo);
  return m;
}

Material lamp(double radiance) {
  Material m = test::emitter(dvec3(radiance));
  m.illuminates = true;
  return m;
}

// A square of a material in the plane z = 0, whose origin the camera sees at an angle from the side.
pack::Scene litFloor(const Material& floor = lambert()) {
  pack::Scene scene = test::emptyScene(2);
  test::look(scene, {3, 0, 4}, {0, 0, 0});
  addSquare(scene, addMaterial(scene, floor), {0.1, 0.2, 0}, {0, 0, 1}, 3);
  return scene;
}

// All renderers give the radiance, to a relative error by sampling, and the same to rounding.
void expectRadiance(const pack::Scene& scene, double radiance, double tolerance, std::uint32_t samples = 256) {
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.lightSamples = samples;
  const auto results = test::renderEverywhere(scene, parameters);
  const double reference = results.at("reference").pixels[1];
  for (const auto& [name, result] : results) {
    EXPECT_NEAR(result.pixels[1], radiance, tolerance * radiance + 1e-7) << name;
    EXPECT_NEAR(result.pixels[1], reference, 2e-5 * reference + 1e-9) << name;
  }
}

// Irradiance at the origin, with normal +z, of a polygon of radiance 1 above the plane. Source: Lambert, Photometria.
double polygonIrradiance(const std::vector<dvec3>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % corners.size()]),
                across = glm::cross(a, b);
    sum += across.z / glm::length(across) * std::atan2(glm::length(across), glm::dot(a, b)) / 2;
  }
  return std::abs(sum);
}

void addTriangle(pack::Scene& scene, std::uint32_t material, const std::vector<dvec3>& corners) {
  pack::Mesh mesh;
  mesh.name = "triangle " + std::to_string(scene.meshes.size());
  mesh.material = material;
  mesh.positions = corners;
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(std::move(mesh));
}

std::vector<dvec3> corners(const pack::Mesh& mesh) { return mesh.positions; }

TEST(AreaLights, SquareLampIsSampledAsARectangle) {
  pack::Scene scene = litFloor();
  addSquare(scene, addMaterial(scene, lamp(2)), {0, 0, 1}, {0, 0, -1}, 0.5);
  const render::AreaLights lights = render::findAreaLights(scene);
  ASSERT_EQ(lights.lights.size(), 1u);
  EXPECT_EQ(lights.lights[0].isRectangle, 1);
  const double x = 0.5 / std::sqrt(1.25), irradiance = 4 * x * std::atan(x);
  EXPECT_NEAR(polygonIrradiance(corners(scene.meshes[1])), irradiance, 1e-12);
  EXPECT_NEAR(irradiance / kPi, 0.239456, 1e-6);
  expectRadiance(scene, 2 * kAlbedo * irradiance / kPi, 2e-3);
}

TEST(AreaLights, TiltedAndPartlyHiddenLamps) {
  pack::Scene scene = litFloor();
  addSquare(scene, addMaterial(scene, lamp(1)), {-1, 0.5, 1.5}, {1, -0.4, -1}, 0.6);
  expectRadiance(scene, kAlbedo * polygonIrradiance(corners(scene.meshes[1])) / kPi, 3e-3);
  // A wall hides the half of a lamp at x < 0.
  pack::Scene half = litFloor();
  addSquare(half, addMaterial(half, lamp(1)), {0, 0, 1}, {0, 0, -1}, 0.5);
  addSquare(half, 0, {0, 0, 0.5}, {0, 0, 1}, 1);
  half.meshes[2].positions = {{-1, -1, 0.5}, {0, -1, 0.5}, {0, 1, 0.5}, {-1, 1, 0.5}};
  expectRadiance(half, kAlbedo * 0.239456 / 2, 2e-2);
}

TEST(AreaLights, TriangleLamp) {
  pack::Scene scene = litFloor();
  const std::vector<dvec3> triangle = {{-0.7, -0.2, 1}, {0.2, 0.9, 1.2}, {0.8, -0.5, 0.7}};  // faces down
  addTriangle(scene, addMaterial(scene, lamp(1)), triangle);
  expectRadiance(scene, kAlbedo * polygonIrradiance(triangle) / kPi, 3e-3);
}

TEST(AreaLights, BacksAreDarkUnlessTwoSided) {
  pack::Scene scene = litFloor();
  addSquare(scene, addMaterial(scene, lamp(1)), {0, 0, 1}, {0, 0, 1}, 0.5);
  expectRadiance(scene, 0, 0);
  scene.materials[1].twoSided = true;
  expectRadiance(scene, kAlbedo * 0.239456, 2e-3);
  scene.materials[1].illuminates = false;
  expectRadiance(scene, 0, 0);
}

// Faces of a body of radiance L radiate as a point of intensity L times their projected area.
TEST(AreaLights, DistantBodyIsAPointLight) {
  pack::Scene scene = litFloor();
  const std::uint32_t material = addMaterial(scene, lamp(100));
  const dvec3 centre(30, 10, 50);
  const dvec3 axes[6] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  double projected = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t top = 4; top < 6; ++top) {
      std::vector<dvec3> face = {centre + axes[i], centre + axes[(i + 1) % 4], centre + axes[top]};
      if (top == 5) std::swap(face[0], face[1]);
      const dvec3 across = glm::cross(face[1] - face[0], face[2] - face[0]);
      ASSERT_GT(glm::dot(across, face[0] - centre), 0);
      projected += std::max(0.0, glm::dot(across, glm::normalize(-centre))) / 2;
      addTriangle(scene, material, face);
    }
  const double distance = glm::length(centre);
  expectRadiance(scene, kAlbedo / kPi * 100 * projected / (distance * distance) * (centre.z / distance), 2e-2);
}

TEST(AreaLights, ManyLampsAddUp) {
  pack::Scene scene = litFloor();
  const std::uint32_t material = addMaterial(scene, lamp(1));
  double irradiance = 0;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) {
      addSquare(scene, material, {i, j, 1.0 + 0.1 * (i * j % 3)}, {0.1 * i, 0, -1}, 0.2);
      irradiance += polygonIrradiance(corners(scene.meshes.back()));
    }
  EXPECT_EQ(render::findAreaLights(scene).lights.size(), 81u);
  expectRadiance(scene, kAlbedo * irradiance / kPi, 1e-2);
}

TEST(AreaLights, MediumAbsorbsOnTheWay) {
  pack::Scene scene = litFloor();
  addSquare(scene, addMaterial(scene, lamp(1)), {0, 0, 20}, {0, 0, -1}, 0.1);
  scene.materials[0].outsideAbsorption = dvec3(0.05);
  const double irradiance = polygonIrradiance(corners(scene.meshes[1]));
  expectRadiance(scene, kAlbedo * irradiance / kPi * std::exp(-0.05 * 20) * std::exp(-0.05 * 5), 1e-3);
}

TEST(AreaLights, PaintIsLitThroughItsInterface) {
  Material paint = test::dielectric(MaterialKind::paint, 1.5, kAlbedo);
  pack::Scene scene = litFloor(paint);
  addSquare(scene, addMaterial(scene, lamp(1000)), {0, 0, 20}, {0, 0, -1}, 0.1);
  const double r0 = 0.04, c = 4.0 / 5;
  const auto r = f64::dielectricReflectance(c, 1, 1.5);
  const double leaving = 1 - (r.rs + r.rp) / 2;
  expectRadiance(scene, 1000 * kAlbedo * polygonIrradiance(corners(scene.meshes[1])) / kPi * (1 - r0) * leaving, 1e-3);
}

// Relative RMS error over an image of a floor under a lamp, against many samples: bounded by 0.35 N^-0.75.
double samplingError(const pack::Scene& scene, std::uint32_t samples, const RenderResult& truth) {
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.lightSamples = samples;
  const RenderResult result = embree::Renderer(scene, 0).render("fresnel", parameters);
  double error = 0, sum = 0;
  for (std::size_t i = 0; i < result.pixels.size(); i += 3) {
    error += std::pow(result.pixels[i] - truth.pixels[i], 2);
    sum += std::pow(truth.pixels[i], 2);
  }
  return std::sqrt(error / sum);
}

pack::Scene room() {
  pack::Scene scene = litFloor(test::dielectric(MaterialKind::paint, 1.5, kAlbedo));
  scene.width = scene.height = 32;
  scene.camera.verticalFovDegrees = 50;
  addSquare(scene, addMaterial(scene, lamp(3)), {0.5, 0.3, 1.2}, {-0.2, 0, -1}, 0.4);
  addTriangle(scene, addMaterial(scene, lamp(5)), {{-1.5, -1, 1}, {-1.2, -0.5, 1.2}, {-0.9, -1, 0.7}});
  addSquare(scene, addMaterial(scene, lambert()), {-0.3, 0.3, 0.4}, {1, 1, 1}, 0.3);
  return scene;
}

TEST(AreaLights, SamplesConverge) {
  const pack::Scene scene = room();
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.lightSamples = 256;
  parameters.samples = 1;
  const RenderResult truth = embree::Renderer(scene, 0).render("fresnel", parameters);
  double before = 1;
  for (const std::uint32_t samples : {1u, 4u, 16u, 64u}) {
    const double error = samplingError(scene, samples, truth);
    EXPECT_LE(error, 0.5 * std::pow(samples, -0.6)) << samples;
    EXPECT_LT(error, before) << samples;
    before = error;
  }
}

// Unpolarized light: the methods differ by rounding, not by noise.
TEST(AreaLights, MethodsSeeTheSameSamples) {
  pack::Scene scene = room();
  scene.environment.radiance = dvec3(0.3);
  scene.environment.illuminates = true;
  scene.depth = 1;
  const RenderParameters parameters = render::defaultParameters(scene);
  embree::Renderer renderer(scene, 0);
  const RenderResult colour = renderer.render("fresnel", parameters), stokes = renderer.render("stokes", parameters);
  for (std::size_t i = 0; i < colour.pixels.size() / 3; ++i)
    ASSERT_NEAR(colour.pixels[3 * i], stokes.pixels[15 * i], 1e-6 * (1 + colour.pixels[3 * i])) << i;
}

TEST(AreaLights, PacketsAndSingleRaysAgreeExactly) {
  pack::Scene scene = room();
  scene.environment.radiance = dvec3(0.3);
  scene.environment.illuminates = true;
  Material polarizer;
  polarizer.kind = MaterialKind::polarizer;
  polarizer.axis = {1, 0, 0};
  polarizer.transmittanceCrossed = dvec3(0);
  addSquare(scene, addMaterial(scene, polarizer), {0.3, 0.3, 0.9}, {0, 0, 1}, 0.4);
  addSquare(scene, addMaterial(scene, test::dielectric(MaterialKind::thinGlass, 1.5)), {-1, -1, 0.5}, {0, 0, 1}, 0.4);
  embree::Renderer renderer(scene, 0);
  for (const char* method : {"fresnel", "stokes", "importance", "sp-ratio"}) {
    RenderParameters parameters = render::defaultParameters(scene);
    parameters.embreePath = render::EmbreePath::packet;
    const RenderResult packets = renderer.render(method, parameters);
    parameters.embreePath = render::EmbreePath::scalar;
    const RenderResult single = renderer.render(method, parameters);
    EXPECT_EQ(packets.pixels, single.pixels) << method;
  }
}

TEST(EnvironmentLight, ConstantGivesItsRadiance) {
  pack::Scene scene = litFloor();
  scene.environment.radiance = {1, 3, 2};
  scene.environment.illuminates = true;
  expectRadiance(scene, kAlbedo * 3, 1e-6, 4);
  // A wall to the left, up to far: half of the directions are blocked.
  scene.meshes.push_back(scene.meshes[0]);
  scene.meshes[1].positions = {{-1e-3, -1e4, -1}, {-1e-3, 1e4, -1}, {-1e-3, 1e4, 1e4}, {-1e-3, -1e4, 1e4}};
  expectRadiance(scene, kAlbedo * 3 / 2, 1e-2);
}

// A map of `size` texels per side with one bright texel.
pack::Environment brightTexel(std::uint32_t size, std::uint32_t column, std::uint32_t row, float radiance) {
  pack::Environment e;
  e.size = size;
  e.illuminates = true;
  e.texels.assign(std::size_t{size + 2} * (size + 2), glm::vec3(0));
  e.texels[std::size_t{row + 1} * (size + 2) + column + 1] = glm::vec3(radiance);
  return e;
}

TEST(EnvironmentLight, OneBrightTexelIsADirectionalLight) {
  constexpr std::uint32_t kSize = 64;
  for (const auto& [column, row] : {std::pair(40u, 30u), std::pair(20u, 38u)}) {
    pack::Scene scene = litFloor();
    scene.environment = brightTexel(kSize, column, row, 1000);
    const dvec3 toward = f64::directionFromOctahedral((column + 0.5) / kSize, (row + 0.5) / kSize);
    ASSERT_GT(toward.z, 0.3);
    // Integrate the tent of bilinear interpolation.
    constexpr int kSteps = 100;
    double irradiance = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const double x = (i + 0.5) * 2 / kSteps - 1, y = (j + 0.5) * 2 / kSteps - 1;
        const dvec3 d = f64::directionFromOctahedral((column + 0.5 + x) / kSize, (row + 0.5 + y) / kSize);
        irradiance += 1000 * (1 - std::abs(x)) * (1 - std::abs(y)) * f64::octahedralSolidAngle(d) * d.z;
      }
    irradiance *= 4.0 / (kSteps * kSteps) / (kSize * kSize);
    expectRadiance(scene, kAlbedo / kPi * irradiance, 3e-2);
    addSquare(scene, 0, toward * 5.0, -toward, 1);
    expectRadiance(scene, 0, 0);
  }
}

Material polarizer(double axisDegrees) {
  Material m;
  m.name = "polarizer";
  m.kind = MaterialKind::polarizer;
  m.axis = {std::cos(axisDegrees * kDegree), std::sin(axisDegrees * kDegree), 0};
  m.transmittanceCrossed = dvec3(0);
  return m;
}

pack::LightSource pointLight(const dvec3& position, double intensity) {
  pack::LightSource light{};
  light.position = position;
  light.intensity = dvec3(intensity);
  return light;
}

// A floor under a point light at distance 2, with polarizers between.
pack::Scene filteredFloor(const std::vector<double>& axes) {
  pack::Scene scene = litFloor();
  scene.lights = {pointLight({0, 0, 2}, 4 * kPi / kAlbedo)};
  double z = 1.9;
  for (const double axis : axes)
    addSquare(scene, addMaterial(scene, polarizer(axis)), {0, 0, z -= 0.2}, {0, 0, 1}, 0.05);
  return scene;
}

TEST(FilteredShadows, PolarizersOnTheWay) {
  expectRadiance(filteredFloor({}), 1, 1e-6);
  expectRadiance(filteredFloor({20}), 0.5, 1e-6);
  expectRadiance(filteredFloor({20, 20}), 0.5, 1e-6);
  expectRadiance(filteredFloor({0, 90}), 0, 0);
  expectRadiance(filteredFloor({0, 45, 90}), 1.0 / 8, 1e-5);
  expectRadiance(filteredFloor({0, 90, 45}), 0, 0);
  expectRadiance(filteredFloor({0, 30, 60, 90}), 0.5 * std::pow(0.75, 3), 1e-5);
  expectRadiance(filteredFloor(std::vector<double>(8, 10.0)), 0.5, 1e-5);
  expectRadiance(filteredFloor(std::vector<double>(9, 10.0)), 0, 0);  // more than 8 surfaces block
}

// Matrices do not commute: a quarter-wave plate between crossed polarizers passes half of the light, beside them none.
TEST(FilteredShadows, OrderOfTheSurfacesCounts) {
  Material plate = polarizer(45);
  plate.kind = MaterialKind::wavePlate;
  plate.transmittanceCrossed = dvec3(1);
  plate.retardanceDegrees = dvec3(90);
  pack::Scene between = filteredFloor({0, 0, 90});
  between.materials[2] = plate;
  expectRadiance(between, 0.25, 1e-5);
  pack::Scene before = filteredFloor({0, 0, 90});
  before.materials[1] = plate;
  expectRadiance(before, 0, 0);
  pack::Scene behind = filteredFloor({0, 90, 0});
  behind.materials[3] = plate;
  expectRadiance(behind, 0, 0);
}

TEST(FilteredShadows, PolarizedLightEntersPaintByItsDirection) {
  // At 60 degrees of incidence, in the plane y = 0: an axis along y is the s direction, which T_s transmits.
  Material paint = test::dielectric(MaterialKind::paint, 1.5, kAlbedo);
  const auto in = f64::dielectricReflectance(0.5, 1, 1.5), out = f64::dielectricReflectance(4.0 / 5, 1, 1.5);
  const double leaving = 1 - (out.rs + out.rp) / 2, unfiltered = kAlbedo / kPi * 100 / 16 * 0.5 * leaving;
  const dvec3 toLight(-std::sqrt(0.75), 0, 0.5);
  for (const bool alongS : {true, false}) {
    pack::Scene scene = litFloor(paint);
    scene.lights = {pointLight(toLight * 4.0, 100)};
    Material filter = polarizer(0);
    filter.axis = alongS ? dvec3(0, 1, 0) : glm::normalize(glm::cross(dvec3(0, 1, 0), toLight));
    addSquare(scene, addMaterial(scene, filter), toLight * 2.0, toLight, 0.5);
    const double radiance = unfiltered * 0.5 * (1 - (alongS ? in.rs : in.rp));
    expectRadiance(scene, radiance, 1e-5);
    // The same of a small lamp that emits polarized light.
    pack::Scene screen = litFloor(paint);
    Material panel = lamp(100 / 0.01);
    panel.polarization = 1;
    panel.axis = filter.axis;
    addSquare(screen, addMaterial(screen, panel), toLight * 4.0, -toLight, 0.05);
    expectRadiance(screen, 2 * radiance, 1e-3);
  }
}

TEST(FilteredShadows, PaneTransmitsAndABodyBlocks) {
  pack::Scene scene = filteredFloor({0});
  scene.materials[1] = test::dielectric(MaterialKind::thinGlass, 1.5);
  expectRadiance(scene, 0.96 / 1.04, 1e-5);
  scene.materials[1] = test::dielectric(MaterialKind::glass, 1.5);
  expectRadiance(scene, 0, 0);
  scene.materials[1] = lambert();
  expectRadiance(scene, 0, 0);
}

TEST(FilteredShadows, AreaLightsAndTheEnvironmentPassFilters) {
  pack::Scene scene = filteredFloor({20});
  scene.lights.clear();
  addSquare(scene, addMaterial(scene, lamp(1000)), {0, 0, 20}, {0, 0, -1}, 0.1);
  const double irradiance = 1000 * polygonIrradiance(corners(scene.meshes.back()));
  expectRadiance(scene, kAlbedo / kPi * irradiance / 2, 1e-3);
  pack::Scene sky = litFloor();
  sky.environment.radiance = dvec3(1);
  sky.environment.illuminates = true;
  addSquare(sky, addMaterial(sky, polarizer(20)), {0, 0, 1e-3}, {0, 0, 1}, 2.5);  // also before the camera
  const double seen = kAlbedo * 0.5 * 0.5;
  expectRadiance(sky, seen, 2e-3);
}

TEST(FilteredShadows, AreLeftOutOnRequest) {
  const pack::Scene scene = filteredFloor({20});
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.filteredShadows = false;
  for (const auto& [name, result] : test::renderEverywhere(scene, parameters)) EXPECT_EQ(result.pixels[1], 0) << name;
}

}  // namespace
}  // namespace malus
