// Meshes that are placed by transforms, on every renderer: closed forms, comparison with copies of the meshes, rays
// that leave surfaces at any scale and distance, and the counts of acceleration structures.
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "bake/pack/instances.h"
#include "render/embree/embree.h"
#include "render/vulkan/acceleration.h"
#include "render/vulkan/instance.h"
#include "render/vulkan/scene_buffers.h"
#include "shaders/optics/optics.h"
#include "tests/render/render_everywhere.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

using pack::MaterialKind;
using test::renderEverywhere;

using test::Stokes;

void expectMiddle(const pack::Scene& scene, const Stokes& truth, double tolerance, const char* what) {
  for (const auto& [name, result] : renderEverywhere(scene))
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(result.pixels[3 + 3 * k], truth[k], tolerance) << what << ", " << name << ", S" << k;
}

glm::dmat3 diagonal(double x, double y, double z) { return {{x, 0, 0}, {0, y, 0}, {0, 0, z}}; }

glm::dmat3 rotation(const glm::dvec3& axis, double angle) {
  const glm::dvec3 n = glm::normalize(axis);
  glm::dmat3 result;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0.0);
    e[i] = 1;
    result[i] = e * std::cos(angle) + glm::cross(n, e) * std::sin(angle) + n * (glm::dot(n, e) * (1 - std::cos(angle)));
  }
  return result;
}

// The first place of every mesh, which no ray of these tests meets.
constexpr glm::dvec3 kFirst{500, 700, 300};

// Places the mesh so that kFirst is at `at`.
void place(pack::Scene& scene, std::uint32_t mesh, const glm::dmat3& linear, const glm::dvec3& at) {
  scene.meshes[mesh].origin = kFirst;
  scene.instances.push_back({"place " + std::to_string(scene.instances.size()), mesh, linear, at - linear * kFirst});
}

// A closed cube of side 1 about kFirst, facing outward.
void addCube(pack::Scene& scene, std::uint32_t material) {
  pack::Mesh mesh;
  mesh.name = "cube " + std::to_string(scene.meshes.size());
  mesh.material = material;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(kFirst + glm::dvec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) - glm::dvec3(0.5));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  scene.meshes.push_back(std::move(mesh));
}

// A sphere of radius 0.5 about kFirst with its normals.
void addSphere(pack::Scene& scene, std::uint32_t material, std::uint32_t around, std::uint32_t rings) {
  pack::Mesh mesh;
  mesh.name = "sphere";
  mesh.material = material;
  for (std::uint32_t ring = 0; ring <= rings; ++ring)
    for (std::uint32_t i = 0; i <= around; ++i) {
      const double theta = std::numbers::pi * ring / rings, phi = 2 * std::numbers::pi * i / around;
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      const glm::vec3 local = 0.5f * n;  // floats relative to kFirst
      mesh.positions.push_back(kFirst + glm::dvec3(local));
      mesh.normals.push_back(glm::normalize(n));
    }
  const std::uint32_t row = around + 1;
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = ring * row + i, b = a + 1, c = a + row, d = c + 1;
      if (ring > 0) mesh.triangles.emplace_back(a, b, c);
      if (ring + 1 < rings) mesh.triangles.emplace_back(b, d, c);
    }
  scene.meshes.push_back(std::move(mesh));
}

pack::Scene along(std::uint32_t depth) {
  pack::Scene scene = test::emptyScene(depth);
  test::look(scene, {0.013, 0.017, 5}, {0.013, 0.017, 0});
  return scene;
}

TEST(Instances, AMirrorAtBrewstersAngle) {
  pack::Scene scene = along(1);
  scene.environment.radiance = glm::dvec3(1);
  const std::uint32_t glass = test::addMaterial(scene, test::dielectric(MaterialKind::mirrorGlass, 1.5));
  test::addSquare(scene, glass, kFirst, {0, 0, 1}, 1);
  // The plane of incidence is horizontal, the reflected field vertical.
  const double rs = std::pow((1 - 1.5 * 1.5) / (1 + 1.5 * 1.5), 2);
  for (const double mirror : {1.0, -1.0}) {
    scene.instances.clear();
    place(scene, 0, rotation({0, 1, 0}, std::atan(1.5)) * diagonal(2 * mirror, 0.5, 1), {0, 0, 0});
    expectMiddle(scene, {rs / 2, -rs / 2, 0, 0}, 1e-6, mirror < 0 ? "mirrored" : "placed");
  }
}

TEST(Instances, AnAbsorbingPaneKeepsItsInside) {
  pack::Scene scene = along(40);
  scene.environment.radiance = glm::dvec3(1);
  pack::Material glass = test::dielectric(MaterialKind::glass, 1.5);
  glass.absorption = glm::dvec3(20);
  addCube(scene, test::addMaterial(scene, glass));
  const double thickness = 0.02, r = 0.04, pass = std::exp(-20 * thickness);
  const double truth = r + (1 - r) * (1 - r) * (r * pass * pass + pass) / (1 - r * r * pass * pass);
  for (const double mirror : {1.0, -1.0}) {
    scene.instances.clear();
    place(scene, 0, diagonal(3 * mirror, 3, thickness), {0.1, 0.2, 0});
    expectMiddle(scene, {truth, 0, 0, 0}, 1e-5, mirror < 0 ? "mirrored" : "placed");
  }
}

TEST(Instances, AMirroredEmitterKeepsItsFront) {
  pack::Scene scene = along(1);
  test::addSquare(scene, test::addMaterial(scene, test::emitter({3, 2, 1})), kFirst, {0, 0, 1}, 1);
  place(scene, 0, diagonal(-1, 1, 1), {0, 0, 0});
  expectMiddle(scene, {3, 0, 0, 0}, 1e-6, "mirrored along x: the front");
  scene.instances.clear();
  place(scene, 0, diagonal(1, 1, -1), {0, 0, 0});
  expectMiddle(scene, {0, 0, 0, 0}, 1e-6, "mirrored along z: the back");
}

// The share of pixels of which a Stokes component differs by more than the tolerance.
double shareOff(const render::RenderResult& a, const render::RenderResult& b, double tolerance) {
  std::size_t off = 0;
  const std::size_t pixels = a.pixels.size() / a.channels;
  for (std::size_t i = 0; i < pixels; ++i) {
    bool differs = false;
    for (std::size_t c = 3; c < 15; ++c)
      differs = differs || !(std::abs(a.pixels[i * a.channels + c] - b.pixels[i * b.channels + c]) <= tolerance);
    off += differs ? 1 : 0;
  }
  return static_cast<double>(off) / static_cast<double>(pixels);
}

// Three spheres that are sheared, mirrored and rotated, under light that differs with the direction.
pack::Scene threeSpheres(const pack::Material& material) {
  pack::Scene scene = test::emptyScene(4);
  scene.width = scene.height = 24;
  scene.camera.verticalFovDegrees = 40;
  test::look(scene, {0.3, 0.8, 5}, {0, 0, 0});
  scene.environment.radiance = {0.2, 0.3, 0.4};
  scene.environment.sun = glm::normalize(glm::dvec3(1, 2, 1));
  scene.environment.skyDegree = 0.6;
  scene.lights = {{{3, 4, 5}, {50, 40, 30}}};
  addSphere(scene, test::addMaterial(scene, material), 32, 16);
  place(scene, 0, glm::dmat3({1.2, 0.1, 0}, {0.5, 1, 0}, {0, -0.3, 0.9}), {-1, 0, 0});
  place(scene, 0, rotation({1, 2, 3}, 1.1) * diagonal(-1, 1.5, 0.8), {0.9, 0.3, 0.2});
  place(scene, 0, rotation({0, 1, 1}, 2.5) * diagonal(0.5, 0.5, 0.5), {0.1, -0.9, 1});
  return scene;
}

TEST(Instances, AreTheCopiesOfTheirMesh) {
  pack::Material paint = test::dielectric(MaterialKind::paint, 1.5, 0.5);
  paint.highlightStrength = 0.5;
  paint.highlightExponent = 50;
  pack::Material glass = test::dielectric(MaterialKind::glass, 1.5);
  glass.absorption = {0.5, 1, 2};
  for (const pack::Material& material : {paint, glass, test::metal({0.2, 0.5, 1.3}, {3.4, 2.2, 1.9})}) {
    const pack::Scene scene = threeSpheres(material);
    const auto placed = renderEverywhere(scene), copied = renderEverywhere(pack::withoutInstances(scene));
    for (const auto& [name, result] : placed)  // apart from pixels at silhouettes and edges
      EXPECT_LE(shareOff(result, copied.at(name), 1e-3), 0.02) << name << ", " << pack::materialKindName(material.kind);
    // Single rays give what packets do.
    render::RenderParameters parameters = render::defaultParameters(scene);
    parameters.stokes = true;
    embree::Renderer embree(scene, 0);
    if (embree.embreePaths().size() < 2) continue;
    parameters.embreePath = render::EmbreePath::packet;
    const render::RenderResult packets = embree.render("stokes", parameters);
    parameters.embreePath = render::EmbreePath::scalar;
    EXPECT_LE(shareOff(packets, embree.render("stokes", parameters), 1e-4), 0.01);
  }
}

struct Extreme {
  const char* name;
  glm::dmat3 linear;
  glm::dvec3 at;
  double size;  // of the cube, about
};

std::vector<Extreme> extremes() {
  const glm::dmat3 turned = rotation({1, 2, 3}, 0.7);
  return {{"plain", glm::dmat3(1.0), {0, 0, 0}, 1},
          {"turned", turned, {3, 2, 1}, 1},
          {"small", turned * diagonal(1e-3, 1e-3, 1e-3), {0.5, 0.25, 0}, 1e-3},
          {"large", turned * diagonal(1e3, 1e3, 1e3), {100, 0, 0}, 1e3},
          {"thin", turned * diagonal(1, 1, 0.002), {0, 0, 0}, 1},
          {"sheared", glm::dmat3({1, 0, 0}, {3, 1, 0}, {0, 2, 1}) * turned, {0, 0, 0}, 3},
          {"mirrored", turned * diagonal(-1, 1, 1), {0, 0, 0}, 1},
          {"far", turned * diagonal(100, 100, 100), {1e5, 2e4, -1e5}, 100}};
}

// Pixels whose green S0 is not `expected`, by renderer.
void expectAll(const pack::Scene& scene, double expected, std::size_t allowed, const char* what) {
  for (const auto& [name, result] : renderEverywhere(scene)) {
    std::size_t off = 0;
    for (std::size_t i = 0; i < result.pixels.size() / result.channels; ++i)
      off += std::abs(result.pixels[i * result.channels + 4] - expected) > 1e-3 ? 1 : 0;
    EXPECT_LE(off, allowed) << what << ", " << name;
  }
}

TEST(Instances, ReflectedRaysDoNotMeetTheirFaceAgain) {
  // A perfect mirror of convex shape, with one reflection: a ray that meets it twice is black.
  for (const Extreme& extreme : extremes()) {
    pack::Scene scene = test::emptyScene(1);
    scene.width = scene.height = 48;
    scene.environment.radiance = glm::dvec3(1);
    addCube(scene, test::addMaterial(scene, test::metal(glm::dvec3(1e-3), glm::dvec3(900))));
    place(scene, 0, extreme.linear, extreme.at);
    scene.camera.verticalFovDegrees = 30;
    test::look(scene, extreme.at + extreme.size * glm::dvec3(1.4, 2.1, 2.6), extreme.at);
    expectAll(scene, 1, 0, extreme.name);
  }
}

TEST(Instances, ClosedBodiesDoNotLeak) {
  // From inside a lamp, before a brighter sky.
  for (const Extreme& extreme : extremes()) {
    pack::Scene scene = test::emptyScene(1);
    scene.width = scene.height = 48;
    scene.environment.radiance = glm::dvec3(1);
    pack::Material lamp = test::emitter(glm::dvec3(0.5));
    lamp.twoSided = true;
    addCube(scene, test::addMaterial(scene, lamp));
    place(scene, 0, extreme.linear, extreme.at);
    scene.camera.verticalFovDegrees = 120;
    test::look(scene, extreme.at, extreme.at + glm::dvec3(0.3, -0.2, -1));
    expectAll(scene, 0.5, 0, extreme.name);
  }
}

TEST(Instances, TransmittedRaysLeaveThinPanes) {
  // Clear glass before a white sky looks white, however often light is reflected within it.
  for (const double thickness : {1e-1, 1e-3}) {
    pack::Scene scene = test::emptyScene(30);
    scene.width = scene.height = 16;
    scene.environment.radiance = glm::dvec3(1);
    addCube(scene, test::addMaterial(scene, test::dielectric(MaterialKind::glass, 1.5)));
    place(scene, 0, rotation({1, 0.2, 0}, 0.4) * diagonal(20, 20, thickness), {0, 0, 0});
    scene.camera.verticalFovDegrees = 20;
    test::look(scene, {0.3, 0.4, 5}, {0, 0, 0});
    expectAll(scene, 1, 0, thickness < 0.01 ? "1 mm" : "10 cm");
  }
}

TEST(Instances, AccelerationStructuresHaveEachMeshOnce) {
  pack::Scene scene = threeSpheres(test::metal(glm::dvec3(1), glm::dvec3(2)));
  test::addSquare(scene, 0, {0, -3, 0}, {0, 1, 0}, 5);
  const pack::Mesh& sphere = scene.meshes[0];
  const render::RenderScene floats = render::makeRenderScene(scene);
  EXPECT_EQ(floats.positions.size(), sphere.positions.size() + 4);
  EXPECT_EQ(floats.triangles.size(), sphere.triangles.size() + 2);
  EXPECT_EQ(floats.meshes.size(), 5u);
  const embree::Bvh bvh(floats, 1);
  EXPECT_EQ(bvh.counts().geometries, 2u);
  EXPECT_EQ(bvh.counts().instances, 4u);  // the square is in the scene itself
  EXPECT_TRUE(bvh.hasInstances());

  const vulkan::Options options;
  const vulkan::Instance instance(options.threads);
  const vulkan::Device device(instance, options.device);
  const vulkan::SceneBuffers buffers(device, floats);
  const vulkan::Acceleration acceleration(device, floats, buffers.positions, buffers.triangles);
  EXPECT_EQ(acceleration.bottoms(), 2u);
  EXPECT_EQ(acceleration.instances(), 5u);

  // Copies: one of each per place, in one bottom level per origin.
  const render::RenderScene copied = render::makeRenderScene(pack::withoutInstances(scene));
  EXPECT_EQ(copied.positions.size(), 4 * sphere.positions.size() + 4);
  EXPECT_FALSE(embree::Bvh(copied, 1).hasInstances());
  EXPECT_EQ(embree::Bvh(copied, 1).counts().geometries, 5u);
}

}  // namespace
}  // namespace malus
