// Textures by the texture coordinates of meshes, on every renderer: closed forms of maps, wrap modes and transforms.
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "render/embree/coverage.h"
#include "tests/render/render_everywhere.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

using pack::Material;
using pack::MaterialKind;
using pack::MeshMap;
using render::RenderResult;
using test::renderEverywhere;

// S0..S3 of one colour in the middle pixel, on all of them.
using test::Stokes;
void expectEverywhere(const pack::Scene& scene, std::size_t colour, const Stokes& truth, double tolerance) {
  for (const auto& [name, result] : renderEverywhere(scene)) {
    const std::size_t pixel = result.pixels.size() / result.channels / 2;
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(result.pixels[pixel * result.channels + 3 + 3 * k + colour], truth[k], tolerance)
          << name << ", S" << k;
  }
}

std::int32_t addTexture(pack::Scene& scene, std::uint32_t width, std::vector<glm::vec3> texels) {
  pack::Texture t;
  t.name = "test";
  t.width = width;
  t.height = static_cast<std::uint32_t>(texels.size()) / width;
  t.texels = std::move(texels);
  scene.textures.push_back(std::move(t));
  return static_cast<std::int32_t>(scene.textures.size() - 1);
}

MeshMap makeMap(std::int32_t texture, std::uint32_t set = 0) {
  MeshMap map;
  map.texture = texture;
  map.set = set;
  return map;
}

// Coordinates of a mesh of test::addSquare in the plane z = 0, which is seen along -z: u = (x + 1) / 2 to the right, v
// = (1 - y) / 2 down, so that the image covers the square from -1 to 1.
void addCoordinates(pack::Mesh& mesh, std::size_t set = 0) {
  for (const glm::dvec3& p : mesh.positions) mesh.textureCoordinates[set].emplace_back((p.x + 1) / 2, (1 - p.y) / 2);
}

// A square of 4 m in z = 0 with the material, seen from z = 5 at (x, y).
pack::Scene square(Material material, std::uint32_t depth = 1) {
  pack::Scene scene = test::emptyScene(depth);
  scene.environment.radiance = glm::dvec3(1);
  test::addSquare(scene, test::addMaterial(scene, std::move(material)), {0, 0, 0}, {0, 0, 1}, 2);
  addCoordinates(scene.meshes[0]);
  return scene;
}
void lookAt(pack::Scene& scene, double x, double y) { test::look(scene, {x, y, 5}, {x, y, 0}); }

// The middle of a texel of a texture of `size` texels per side.
double middleX(int column, int size) { return 2 * (column + 0.5) / size - 1; }
double middleY(int row, int size) { return 1 - 2 * (row + 0.5) / size; }

// Reflectance at normal incidence, and of s and p at a cosine, of a conductor in air.
double fresnel(double n, double k, double c, bool isP) {
  const std::complex<double> eta(n, -k), sine2(1 - c * c), t = std::sqrt(eta * eta - sine2);
  const std::complex<double> r = isP ? (eta * eta * c - t) / (eta * eta * c + t) : (c - t) / (c + t);
  return std::norm(r);
}

// A texture of 2 x 2 texels in one channel of three.
const std::vector<glm::vec3> kFour = {{0.1f, 0.9f, 0.3f}, {0.2f, 0.8f, 0.5f}, {0.6f, 0.7f, 0.2f}, {0.4f, 0.5f, 0.6f}};

TEST(MeshTextures, EachTexelOfAMetalHasItsFresnelReflectance) {
  Material metal = test::metal(glm::dvec3(1), glm::dvec3(1));
  metal.meshMaps.eta = makeMap(0);
  metal.meshMaps.k = makeMap(1);
  pack::Scene scene = square(metal);
  addTexture(scene, 2, kFour);
  addTexture(scene, 2, {{1, 2, 3}, {2, 3, 4}, {3, 4, 5}, {4, 5, 6}});
  for (int texel = 0; texel < 4; ++texel)
    for (int colour = 0; colour < 3; ++colour) {
      const double x = middleX(texel % 2, 2), y = middleY(texel / 2, 2),
                   n = kFour[static_cast<std::size_t>(texel)][colour], k = texel + colour + 1;
      // At 50 degrees, in the plane of x: s is along y, which is S1 < 0.
      const double a = 50 * std::numbers::pi / 180, c = std::cos(a);
      test::look(scene, {x + 3 * std::sin(a), y, 3 * c}, {x, y, 0});
      const double rs = fresnel(n, k, c, false), rp = fresnel(n, k, c, true);
      expectEverywhere(scene, static_cast<std::size_t>(colour), {(rs + rp) / 2, (rp - rs) / 2, 0, 0}, 3e-6);
    }
}

TEST(MeshTextures, ReflectanceOfAMetalIsThatOfTheTexel) {
  Material metal = test::metal(glm::dvec3(1), glm::dvec3(1));
  metal.meshMaps.reflectance = makeMap(0);
  pack::Scene scene = square(metal);
  addTexture(scene, 2, kFour);
  for (int texel = 0; texel < 4; ++texel) {
    lookAt(scene, middleX(texel % 2, 2), middleY(texel / 2, 2));
    for (int c = 0; c < 3; ++c)
      expectEverywhere(scene, static_cast<std::size_t>(c), {kFour[static_cast<std::size_t>(texel)][c], 0, 0, 0}, 2e-6);
  }
  // Half way between the texels of a row; without an edge tint a dielectric, which polarizes fully at Brewster's angle.
  lookAt(scene, 0, middleY(0, 2));
  expectEverywhere(scene, 0, {0.15, 0, 0, 0}, 2e-6);
  scene.materials[0].meshMaps.metallic = makeMap(addTexture(scene, 1, {glm::vec3(0)}));
  scene.textures[0].texels.assign(4, glm::vec3(0.04f));
  const double brewster = std::atan(1.5);
  test::look(scene, {3 * std::sin(brewster), 0, 3 * std::cos(brewster)}, {0, 0, 0});
  const double rs = std::pow((1 - 1.5 * 1.5) / (1 + 1.5 * 1.5), 2);
  expectEverywhere(scene, 1, {rs / 2, -rs / 2, 0, 0}, 1e-6);
}

// The red reflectance at a position, of the map of a scene with one row of four texels.
void expectRow(pack::Scene& scene, double u, double truth) {
  lookAt(scene, 2 * u - 1, 0.3);
  expectEverywhere(scene, 0, {truth, 0, 0, 0}, 2e-6);
}

TEST(MeshTextures, WrapModesContinueTheImage) {
  Material lambert;
  lambert.albedo = glm::dvec3(0.5);
  lambert.meshMaps.albedo = makeMap(0);
  pack::Scene scene = square(lambert, 0);
  scene.environment.ambientIrradiance = 1;
  bake::bakeConstantEnvironment(glm::dvec3(1), scene.environment);
  addTexture(scene, 4, {glm::vec3(0.1f), glm::vec3(0.2f), glm::vec3(0.4f), glm::vec3(0.8f)});
  expectRow(scene, 0.375, 0.2);
  expectRow(scene, 1.125, 0.1);
  expectRow(scene, -0.125, 0.8);
  expectRow(scene, 0, 0.45);  // between the last and the first
  scene.materials[0].meshMaps.albedo.wrapU = pack::Wrap::clamp;
  expectRow(scene, 1.125, 0.8);
  expectRow(scene, -0.4, 0.1);
  expectRow(scene, 0, 0.1);
  scene.materials[0].meshMaps.albedo.wrapU = pack::Wrap::mirror;
  expectRow(scene, 1.125, 0.8);
  expectRow(scene, 1.375, 0.4);
  expectRow(scene, -0.375, 0.2);
  expectRow(scene, 0, 0.1);
}

TEST(MeshTextures, TransformsAndTheSecondSetChooseTheTexel) {
  Material lambert;
  lambert.meshMaps.albedo = makeMap(0, 1);
  pack::Scene scene = square(lambert, 0);
  scene.environment.ambientIrradiance = 1;
  bake::bakeConstantEnvironment(glm::dvec3(1), scene.environment);
  addTexture(scene, 2, kFour);
  lookAt(scene, 0.5, 0.5);  // without a second set every point is at (0, 0): the corner of four repeated texels
  expectEverywhere(scene, 0, {(0.1 + 0.2 + 0.6 + 0.4) / 4, 0, 0, 0}, 2e-6);
  scene.meshes[0].textureCoordinates[1] = scene.meshes[0].textureCoordinates[0];
  expectEverywhere(scene, 0, {0.2, 0, 0, 0}, 2e-6);
  // Rotated by a quarter: u' = v, v' = 1 - u; then moved by half an image.
  scene.materials[0].meshMaps.albedo.u = {0, 1, 0};
  scene.materials[0].meshMaps.albedo.v = {-1, 0, 1};
  expectEverywhere(scene, 0, {0.1, 0, 0, 0}, 2e-6);
  scene.materials[0].meshMaps.albedo.v = {-1, 0, 1.5};
  expectEverywhere(scene, 0, {0.6, 0, 0, 0}, 2e-6);
}

TEST(MeshTextures, RadianceOfEmittersAndOfTheDiffuseLayer) {
  Material panel = test::emitter({1, 1, 1});
  panel.meshMaps.radiance = makeMap(0);
  pack::Scene scene = square(panel, 0);
  addTexture(scene, 2, {{100, 2, 3}, {5, 6, 7}, {0, 0, 0}, {1, 2, 3}});
  lookAt(scene, middleX(1, 2), middleY(0, 2));
  expectEverywhere(scene, 2, {7, 0, 0, 0}, 2e-5);
  // Below an interface it leaves with T = 1 - R = 0.96, beside the reflection of the environment.
  Material paint = test::dielectric(MaterialKind::paint, 1.5);
  paint.meshMaps.radiance = makeMap(0);
  scene.materials[0] = paint;
  scene.depth = 1;
  expectEverywhere(scene, 2, {7 * 0.96 + 0.04, 0, 0, 0}, 2e-5);
}

TEST(MeshTextures, TransmittanceOfAPane) {
  Material pane = test::dielectric(MaterialKind::thinGlass, 1.5);
  pane.meshMaps.transmittance = makeMap(0);
  pack::Scene scene = square(pane, 1);
  addTexture(scene, 2, kFour);
  scene.environment.radiance = glm::dvec3(1);
  lookAt(scene, middleX(0, 2), middleY(1, 2));
  // Both interfaces with all internal reflections: R + T of an absorbing plate at normal incidence.
  const double r = 0.04, a = 0.6, t = (1 - r) * (1 - r) * a / (1 - r * r * a * a), reflected = r + r * a * t;
  expectEverywhere(scene, 0, {t + reflected, 0, 0, 0}, 2e-6);
}

TEST(MeshTextures, RoughnessOfATexelIsThatOfAUniformMaterial) {
  Material metal = test::metal(glm::dvec3(0.2), glm::dvec3(3));
  metal.meshMaps.roughness = makeMap(0);
  pack::Scene scene = square(metal);
  addTexture(scene, 2, {glm::vec3(0.3f), glm::vec3(0), glm::vec3(0.1f), glm::vec3(0.5f)});
  scene.environment.sun = glm::normalize(glm::dvec3(1, 2, 1));
  scene.environment.skyDegree = 0.8;
  for (int texel = 0; texel < 4; ++texel) {
    const double x = middleX(texel % 2, 2), y = middleY(texel / 2, 2);
    test::look(scene, {x + 1, y + 1, 2}, {x, y, 0});
    pack::Scene uniform = scene;
    uniform.materials[0].meshMaps = {};
    uniform.materials[0].roughness = static_cast<double>(scene.textures[0].texels[static_cast<std::size_t>(texel)].x);
    const auto mapped = renderEverywhere(scene), constant = renderEverywhere(uniform);
    for (const auto& [name, result] : mapped)
      for (std::size_t i = 0; i < result.pixels.size(); ++i)
        EXPECT_NEAR(result.pixels[i], constant.at(name).pixels[i], 2e-6) << name << ' ' << texel;
  }
}

// A mirror of metal in z = 0 with a uniform normal map of the normal n.
Material mappedMirror(pack::Scene& scene, const glm::dvec3& n, MeshMap map = {}) {
  Material metal = test::metal(glm::dvec3(0.2), glm::dvec3(3));
  map.texture = addTexture(scene, 1, {glm::vec3(glm::normalize(n) * 0.5 + 0.5)});
  metal.meshMaps.normal = map;
  return metal;
}

// Expects the image of a mapped mirror to be that of a mirror whose face has the normal n, at its middle.
void expectTilted(const pack::Scene& mapped, const glm::dvec3& n) {
  pack::Scene tilted = mapped;
  tilted.materials[0].meshMaps = {};
  tilted.meshes.clear();
  tilted.instances.clear();
  test::addSquare(tilted, 0, {0, 0, 0}, n, 2);
  render::RenderParameters parameters = render::defaultParameters(tilted);
  const RenderResult truth = reference::render(tilted, parameters, 0);
  for (std::size_t k = 1; k < 4; ++k) EXPECT_GT(std::abs(truth.pixels[3 + 3 * k]), 1e-4) << "S" << k;
  for (const auto& [name, result] : renderEverywhere(mapped))
    for (std::size_t i = 3; i < result.channels; ++i)
      EXPECT_NEAR(result.pixels[i], truth.pixels[i], 4e-6) << name << ", channel " << i;
}

// A polarized sky, in which every Stokes component of a mirror image differs from 0.
void addSky(pack::Scene& scene) {
  scene.environment.radiance = {1, 2, 3};
  scene.environment.sun = glm::normalize(glm::dvec3(0.3, 0.5, -0.8));
  scene.environment.skyDegree = 0.8;
}

TEST(NormalMaps, AConstantNormalIsATiltedMirror) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.2, 1));
  pack::Scene scene = square({});
  scene.materials[0] = mappedMirror(scene, n);
  addSky(scene);
  test::look(scene, {2, 0.7, 2}, {0, 0, 0});
  expectTilted(scene, n);  // x of the map is that of the scene, y is up in the image, as y of the scene
  // By tangents of the mesh, rotated by a quarter: tangent y, bitangent -x.
  scene.meshes[0].tangents.assign(4, {0, 1, 0, 1});
  expectTilted(scene, {-n.y, n.x, n.z});
  // The opposite bitangent.
  scene.meshes[0].tangents.assign(4, {0, 1, 0, -1});
  expectTilted(scene, {n.y, n.x, n.z});
  // Without them and with mirrored coordinates, the map's x is -x of the scene.
  scene.meshes[0].tangents.clear();
  for (glm::vec2& uv : scene.meshes[0].textureCoordinates[0]) uv.x = -uv.x;
  expectTilted(scene, {-n.x, n.y, n.z});
  // normalScale.
  scene.materials[0].meshMaps.normalScale = 0.5;
  expectTilted(scene, glm::normalize(glm::dvec3(-0.5 * n.x, 0.5 * n.y, n.z)));
}

TEST(NormalMaps, InterpolatedNormalsCarryTheFrame) {
  // Vertex normals tilted about x: the map's tangent is x, its bitangent perpendicular to both.
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0, -0.4, 1)), bitangent = glm::cross(normal, {1, 0, 0}),
                   n = glm::normalize(glm::dvec3(0.2, 0.3, 1));
  pack::Scene scene = square({});
  scene.materials[0] = mappedMirror(scene, n);
  scene.meshes[0].normals.assign(4, glm::vec3(normal));
  addSky(scene);
  test::look(scene, {2, 0.7, 2}, {0, 0, 0});
  expectTilted(scene, glm::dvec3(1, 0, 0) * n.x + bitangent * n.y + normal * n.z);
}

TEST(NormalMaps, PlacedMeshesTurnAndMirrorTheFrame) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.2, 1)), first(50, 0, 0);
  pack::Scene scene = square({});
  scene.materials[0] = mappedMirror(scene, n);
  addSky(scene);
  test::look(scene, {2, 0.7, 2}, {0, 0, 0});
  pack::Mesh& mesh = scene.meshes[0];
  for (glm::dvec3& p : mesh.positions) p += first;
  mesh.origin = first;
  const auto expectPlaced = [&](const glm::dmat3& linear, const glm::dvec3& placed) {
    scene.instances = {{"place", 0, linear, -(linear * first)}};
    expectTilted(scene, placed);
  };
  const glm::dmat3 mirrored(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));
  const glm::dmat3 turned(glm::dvec3(0, 2, 0), glm::dvec3(-2, 0, 0), glm::dvec3(0, 0, 2));  // by a quarter, enlarged
  expectPlaced(mirrored, {-n.x, n.y, n.z});  // by the derivatives of the coordinates
  mesh.tangents.assign(4, {1, 0, 0, 1});
  expectPlaced(turned, {-n.y, n.x, n.z});
  expectPlaced(turned * mirrored, {-n.y, -n.x, n.z});
}

TEST(NormalMaps, ANormalThatFacesAwayGivesWayToTheFace) {
  pack::Scene scene = square({});
  scene.materials[0] = mappedMirror(scene, {-0.9, 0, 0.2});
  addSky(scene);
  test::look(scene, {3, 0.5, 1}, {0, 0, 0});
  expectTilted(scene, {0, 0, 1});
}

TEST(CutOuts, HolesLetRaysAndShadowRaysPass) {
  // A sheet with holes in front of a white floor, under a point light: a checkerboard of coverage.
  Material sheet;
  sheet.albedo = glm::dvec3(0.25);
  sheet.meshMaps.coverage = makeMap(0);
  pack::Scene scene = square(sheet, 0);
  addTexture(scene, 2, {glm::vec3(1), glm::vec3(0), glm::vec3(0), glm::vec3(1)});
  Material floor;
  floor.albedo = glm::dvec3(1);
  test::addSquare(scene, test::addMaterial(scene, floor), {0, 0, -1}, {0, 0, 1}, 10);
  scene.environment.radiance = glm::dvec3(0);
  scene.lights.push_back({{0.3, -0.2, 4}, glm::dvec3(7)});
  const double pi = std::numbers::pi;
  const auto lit = [&](const glm::dvec3& p, double albedo) {
    const glm::dvec3 to = scene.lights[0].position - p;
    return albedo / pi * 7 * to.z / std::pow(glm::length(to), 3);
  };
  // The sheet itself, upper left; through a hole at its upper right to a lit point, and past an edge to a shaded one.
  lookAt(scene, -0.5, 0.5);
  expectEverywhere(scene, 0, {lit({-0.5, 0.5, 0}, 0.25), 0, 0, 0}, 1e-6);
  lookAt(scene, 0.5, 0.5);
  expectEverywhere(scene, 0, {lit({0.5, 0.5, -1}, 1), 0, 0, 0}, 1e-6);
  test::look(scene, {4.1, -0.025, 3},
             {-0.7, 0.675, -1});  // through the hole above, to a point in the shadow of the sheet
  expectEverywhere(scene, 0, {0, 0, 0, 0}, 1e-6);
  // With a mirror below: a secondary ray passes the other hole.
  scene.depth = 1;
  scene.materials[1] = test::metal(glm::dvec3(0.2), glm::dvec3(3));
  scene.environment.radiance = glm::dvec3(1);
  scene.materials[0].albedo = glm::dvec3(0);
  test::look(scene, {0.5 - 4 * 0.1, 0.5, 3}, {0.5, 0.5, -1});
  const double c = 4 / std::sqrt(16.16), r = (fresnel(0.2, 3, c, false) + fresnel(0.2, 3, c, true)) / 2;
  for (const auto& [name, result] : renderEverywhere(scene)) EXPECT_NEAR(result.pixels[3], r, 1e-6) << name;
  // From the same point, one that meets the sheet from below.
  test::look(scene, {0.2 + 4 * 0.5, 0.5, 3}, {0.2, 0.5, -1});
  for (const auto& [name, result] : renderEverywhere(scene)) EXPECT_NEAR(result.pixels[3], 0, 1e-6) << name;
}

TEST(CutOuts, HolesAreNotCovered) {
  Material sheet;
  sheet.meshMaps.coverage = makeMap(0);
  pack::Scene scene = square(sheet, 0);
  addTexture(scene, 2, {glm::vec3(1), glm::vec3(0), glm::vec3(0), glm::vec3(1)});
  const auto covered = [&](double x, double y) {
    lookAt(scene, x, y);
    return embree::coverage(scene, render::defaultParameters(scene), 1);
  };
  EXPECT_EQ(covered(-0.5, 0.5), std::vector<float>{1});
  EXPECT_EQ(covered(0.5, 0.5), std::vector<float>{0});
}

// A floor of black and white squares of 0.1 m, seen at a grazing angle, reflects the mean of an environment.
pack::Scene checkeredFloor(Material material) {
  pack::Scene scene = test::emptyScene(2);
  scene.environment.radiance = glm::dvec3(1);
  test::addSquare(scene, test::addMaterial(scene, std::move(material)), {0, 0, 0}, {0, 0, 1}, 1000);
  for (const glm::dvec3& p : scene.meshes[0].positions)
    scene.meshes[0].textureCoordinates[0].emplace_back(p.x * 5, -p.y * 5);
  addTexture(scene, 2, {glm::vec3(0.9f), glm::vec3(0.1f), glm::vec3(0.1f), glm::vec3(0.9f)});
  scene.width = scene.height = 24;
  scene.camera.verticalFovDegrees = 4;
  test::look(scene, {0, -100, 12}, {0, 0, 0}, {0, 0, 1});
  return scene;
}

TEST(TextureLevels, ADistantFloorHasTheMeanAtOneRayPerPixel) {
  Material metal = test::metal(glm::dvec3(1), glm::dvec3(1));
  metal.meshMaps.reflectance = makeMap(0);
  // A pixel covers 0.29 m, three squares: every pixel is the metal of the mean reflectance 0.5.
  const pack::Scene scene = checkeredFloor(metal);
  const double n = 0.5 / 1.5, k = 2 * std::sqrt(0.5) / 1.5;
  for (const auto& [name, result] : renderEverywhere(scene))
    for (std::size_t i = 0; i < result.pixels.size(); i += result.channels) {
      const std::size_t row = i / result.channels / result.width;
      const double a = std::atan2(12.0, 100.0) +
                       std::tan(2 * std::numbers::pi / 180) * (static_cast<double>(row) + 0.5 - 12) / 12,
                   c = std::sin(a);
      EXPECT_NEAR(result.pixels[i + 3], (fresnel(n, k, c, false) + fresnel(n, k, c, true)) / 2, 2e-3) << name;
    }
  // The same texture up close is not blurred.
  pack::Scene close = scene;
  close.width = close.height = 1;
  close.camera.verticalFovDegrees = 0.01;
  test::look(close, {0.05, 0.05, 1}, {0.05, 0.05, 0});
  for (const auto& [name, result] : renderEverywhere(close))
    EXPECT_LT(std::min(std::abs(result.pixels[3] - 0.9), std::abs(result.pixels[3] - 0.1)), 3e-3)
        << name;  // 5000 repeats from the origin
}

TEST(TextureLevels, ACurvedMirrorWidensTheCone) {
  // The floor in a small convex mirror, whose image shrinks it: without the curvature it would alias.
  Material floor;
  floor.meshMaps.albedo = makeMap(0);
  floor.albedo = glm::dvec3(0.5);
  pack::Scene scene = checkeredFloor(floor);
  bake::bakeConstantEnvironment(glm::dvec3(1), scene.environment);
  scene.environment.ambientIrradiance = 1;
  const std::uint32_t mirror = test::addMaterial(scene, test::metal(glm::dvec3(0.01), glm::dvec3(30)));
  // A square of 2 cm whose normals are those of a sphere of 2 cm radius: it magnifies angles 100 times.
  test::addSquare(scene, mirror, {0, 0, 2}, {0, 0, -1}, 0.01);
  for (const glm::dvec3& p : scene.meshes[1].positions)
    scene.meshes[1].normals.emplace_back(glm::normalize(p - glm::dvec3(0, 0, 2.02)));
  scene.width = scene.height = 9;
  scene.camera.verticalFovDegrees = 2 * std::atan(0.007) * 180 / std::numbers::pi;
  test::look(scene, {0.0005, 0.0007, 1}, {0.0005, 0.0007, 2}, {0, 1, 0});
  for (const auto& [name, result] : renderEverywhere(scene))
    for (std::size_t i = 0; i < result.pixels.size(); i += result.channels)
      EXPECT_NEAR(result.pixels[i + 3], 0.5, 0.06) << name << ' ' << i / result.channels;
}

}  // namespace
}  // namespace malus
