// Whole renderers against closed forms: what the optics tests cannot see (frames along real rays, sides,
// depth, which interface is met).
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bake/bake.h"
#include "bake/materials/absorption_precision.h"
#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/scene/methods.h"
#include "tests/bake/fixtures.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

using pack::MaterialKind;
constexpr double kN = 1.5;

struct Powers {
  double s, p;
};
// Fresnel 1823, from the angles; written here anew.
Powers fresnel(double cosine, double n1, double n2) {
  const double sine = std::sqrt(1 - cosine * cosine) * n1 / n2;
  if (sine >= 1) return {1, 1};
  const double t = std::sqrt(1 - sine * sine);
  const double s = (n1 * cosine - n2 * t) / (n1 * cosine + n2 * t), p = (n2 * cosine - n1 * t) / (n2 * cosine + n1 * t);
  return {s * s, p * p};
}

// Stokes vector of the green channel of the one pixel.
glm::dvec4 reference(const pack::Scene& scene) {
  const render::RenderResult p = reference::render(scene, render::defaultParameters(scene), 1);
  return {p.pixels[4], p.pixels[7], p.pixels[10], p.pixels[13]};
}
glm::dvec4 embreeStokes(const pack::Scene& scene) {
  const render::RenderResult p = embree::Renderer(scene, 1).render("stokes", render::defaultParameters(scene));
  return {p.pixels[4], p.pixels[7], p.pixels[10], p.pixels[13]};
}
double embreeColour(const pack::Scene& scene, const char* method) {
  return embree::Renderer(scene, 1).render(method, render::defaultParameters(scene)).pixels[1];
}

// A glass mirror in the plane y = 0 under a white sky, seen at an angle from its normal.
pack::Scene glassMirror(double degrees) {
  pack::Scene scene = test::emptyScene(4);
  scene.environment.radiance = glm::dvec3(1);
  test::addMaterial(scene, test::dielectric(MaterialKind::mirrorGlass, kN));
  test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 10);
  const double a = degrees * std::numbers::pi / 180;
  test::look(scene, {0, std::cos(a), std::sin(a)}, {0, 0, 0});
  return scene;
}

TEST(ClosedForms, OneGlassMirror) {
  for (const double degrees : {1.0, 30.0, 56.309932, 75.0, 89.0}) {
    const pack::Scene scene = glassMirror(degrees);
    const Powers r = fresnel(std::cos(degrees * std::numbers::pi / 180), 1, kN);
    const glm::dvec4 s = reference(scene), f = embreeStokes(scene);
    // s is the x axis of the image: S1 is positive.
    EXPECT_NEAR(s[0], (r.s + r.p) / 2, 1e-6) << degrees;
    EXPECT_NEAR(s[1], (r.s - r.p) / 2, 1e-6) << degrees;
    EXPECT_NEAR(s[2], 0, 1e-6);
    EXPECT_NEAR(s[3], 0, 1e-6);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(f[i], s[i], 2e-6) << degrees;
    EXPECT_NEAR(embreeColour(scene, "fresnel"), (r.s + r.p) / 2, 2e-6);
    EXPECT_NEAR(embreeColour(scene, "sp-malus"), (r.s + r.p) / 2, 2e-6);
  }
}

TEST(ClosedForms, PolarizerOverAGlassMirrorAtBrewster) {
  const pack::Scene scene = glassMirror(std::atan(kN) * 180 / std::numbers::pi);
  const Powers r = fresnel(1 / std::sqrt(1 + kN * kN), 1, kN);
  render::RenderParameters parameters = render::defaultParameters(scene);
  for (const double degrees : {0.0, 30.0, 90.0}) {
    parameters.analyser = render::linearPolarizer(degrees);
    const double expected = 0.5 * r.s * std::pow(std::cos(degrees * std::numbers::pi / 180), 2);
    EXPECT_NEAR(reference::render(scene, parameters, 1).pixels[1], expected, 1e-6) << degrees;
    EXPECT_NEAR(embree::Renderer(scene, 1).render("stokes", parameters).pixels[1], expected, 2e-6) << degrees;
    EXPECT_NEAR(embree::Renderer(scene, 1).render("sp", parameters).pixels[1], expected, 2e-6) << degrees;
    // Without polarization the filter only halves.
    EXPECT_NEAR(embree::Renderer(scene, 1).render("fresnel", parameters).pixels[1], 0.25 * r.s, 2e-6) << degrees;
  }
}

// Two glass mirrors at Brewster's angle, the second turned by `twist` degrees about the ray between them.
pack::Scene twoMirrors(double twist) {
  pack::Scene scene = test::emptyScene(4);
  scene.environment.radiance = glm::dvec3(1);
  test::addMaterial(scene, test::dielectric(MaterialKind::mirrorGlass, kN));
  const double brewster = std::atan(kN), a = twist * std::numbers::pi / 180;
  // The camera looks along -z at the first mirror, which sends the ray along d.
  const glm::dvec3 in(0, 0, -1), n1(0, std::sin(brewster), std::cos(brewster));
  const glm::dvec3 d = glm::normalize(in - 2 * glm::dot(in, n1) * n1);
  test::addSquare(scene, 0, {0, 0, 0}, n1, 0.5);
  // The second mirror's normal: at Brewster's angle from -d, about d by the twist.
  const glm::dvec3 s = glm::normalize(glm::cross(d, n1)), t = glm::cross(s, d);
  const glm::dvec3 side = t * std::cos(a) + s * std::sin(a);
  test::addSquare(scene, 0, d * 5.0, -d * std::cos(brewster) + side * std::sin(brewster), 0.5);
  test::look(scene, {0, 0, 3}, {0, 0, 0});
  return scene;
}

TEST(ClosedForms, TwoBrewsterMirrorsFollowMalus) {
  const double rs = fresnel(1 / std::sqrt(1 + kN * kN), 1, kN).s;
  for (const double twist : {0.0, 30.0, 45.0, 60.0, 90.0}) {
    const pack::Scene scene = twoMirrors(twist);
    // A1 A2 (1 + D1 D2 cos 2f) with D = 1: R_s^2 cos^2 f / 2.
    const double expected = rs * rs * std::pow(std::cos(twist * std::numbers::pi / 180), 2) / 2;
    EXPECT_NEAR(reference(scene)[0], expected, 1e-7) << twist;
    EXPECT_NEAR(embreeStokes(scene)[0], expected, 1e-6) << twist;
    EXPECT_NEAR(embreeColour(scene, "sp-malus"), expected, 1e-6) << twist;
    EXPECT_NEAR(embreeColour(scene, "fresnel"), rs * rs / 4, 1e-6) << twist;
    // The paper's rule keeps |cos| where Malus's law has cos^2.
    EXPECT_NEAR(embreeColour(scene, "sp"), rs * rs * std::abs(std::cos(twist * std::numbers::pi / 180)) / 2, 1e-6)
        << twist;
  }
}

// A slab of clear glass between the camera and a white sky, tilted: all orders of internal reflection.
TEST(ClosedForms, SlabOfGlassSumsAllOrders) {
  for (const double degrees : {0.0, 40.0, 60.0, 80.0}) {
    pack::Scene scene = test::emptyScene(30);
    // Light comes from below only, so that reflections at the top see black.
    test::addMaterial(scene, test::dielectric(MaterialKind::glass, kN));
    test::addMaterial(scene, test::emitter(glm::dvec3(1)));
    test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 500);
    test::addSquare(scene, 0, {0, -0.1, 0}, {0, -1, 0}, 500);
    test::addSquare(scene, 1, {0, -1, 0}, {0, 1, 0}, 500);
    const double a = degrees * std::numbers::pi / 180;
    test::look(scene, {0, std::cos(a), std::sin(a)}, {0, 0, 0},
               degrees < 1 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0));
    const Powers r = fresnel(std::cos(a), 1, kN);
    const double ts = (1 - r.s) / (1 + r.s), tp = (1 - r.p) / (1 + r.p);
    // At most 30 interactions: the rest is below R^28.
    const double rest = std::pow(r.s, 28);
    const glm::dvec4 light = reference(scene);
    EXPECT_NEAR(light[0], (ts + tp) / 2, 1e-6 + rest) << degrees;
    EXPECT_NEAR(light[1], (ts - tp) / 2, 1e-6 + rest) << degrees;
    EXPECT_NEAR(embreeStokes(scene)[0], (ts + tp) / 2, 1e-5 + rest) << degrees;
  }
}

// Two diattenuators: a Brewster mirror that reflects paint at grazing incidence.
TEST(ClosedForms, PaintLeavesPolarized) {
  for (const double degrees : {0.0, 70.0, 80.0}) {
    pack::Scene scene = test::emptyScene(0);  // no mirror reflection: diffuse light alone
    test::addMaterial(scene, test::dielectric(MaterialKind::paint, kN, 0.5));
    test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 10);
    const double a = degrees * std::numbers::pi / 180;
    test::look(scene, {0, std::cos(a), std::sin(a)}, {0, 0, 0},
               degrees < 1 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0));
    scene.lights.push_back({{0, 2, 0}, {8, 8, 8}});
    const Powers r = fresnel(std::cos(a), 1, kN), entering = fresnel(1, 1, kN);
    // albedo/pi x I/d^2 x (1 - R at normal incidence), out through T_s and T_p.
    const double below = 0.5 / std::numbers::pi * 2 * (1 - entering.s);
    const glm::dvec4 light = reference(scene);
    EXPECT_NEAR(light[0], below * (1 - (r.s + r.p) / 2), 1e-6) << degrees;
    EXPECT_NEAR(light[1], below * (r.p - r.s) / 2, 1e-6) << degrees;
    const glm::dvec4 f = embreeStokes(scene);
    EXPECT_NEAR(f[0], light[0], 3e-6);
    EXPECT_NEAR(f[1], light[1], 3e-6);
  }
}

// A light in the point that a ray hits has no direction there; the pixels around it are lit.
TEST(ClosedForms, LightOnTheSurfaceIsFinite) {
  pack::Scene scene = test::emptyScene(0);
  scene.width = scene.height = 3;
  test::addMaterial(scene, test::dielectric(MaterialKind::lambert, 1, 0.5));
  test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 10);
  test::look(scene, {0, 1, 0}, {0, 0, 0}, {0, 0, -1});
  scene.lights.push_back({{0, 0, 0}, {8, 8, 8}});
  const render::RenderResult result = reference::render(scene, render::defaultParameters(scene), 1);
  for (const float value : result.pixels) EXPECT_EQ(value, 0);  // all light is grazing
}

// A pane of 2 mm that absorbs half of the light along its normal n, its corners rounded to floats as in a pack.
pack::Scene halfAbsorbingPane(double size, const glm::dvec3& n) {
  constexpr double kThickness = 2e-3;
  pack::Scene scene = test::emptyScene(2);
  scene.environment.radiance = glm::dvec3(1);
  pack::Material glass = test::dielectric(MaterialKind::glass, 1.0001);
  glass.absorption = glm::dvec3(std::log(2.0) / kThickness);
  test::addMaterial(scene, glass);
  test::addSquare(scene, 0, n * (kThickness / 2), n, size / 2);
  test::addSquare(scene, 0, n * (-kThickness / 2), -n, size / 2);
  for (pack::Mesh& mesh : scene.meshes) {
    mesh.openSurface = true;
    for (glm::dvec3& p : mesh.positions) p = glm::dvec3(glm::vec3(p));
  }
  const glm::dvec3 at = glm::cross(n, glm::dvec3(0.2, 0.1, 0.4)) * (0.3 * size);
  test::look(scene, at + n, at, {0.3, 0.1, -1});
  return scene;
}

TEST(ClosedForms, AbsorptionOfLargeThinPanesErrsAsReported) {
  const glm::dvec3 oblique = glm::normalize(glm::dvec3(0.3, 0.8, 0.5));
  for (const glm::dvec3& n : {glm::dvec3(0, 1, 0), oblique})
    for (const double size : {2.0, 20.0, 200.0, 2000.0}) {
      const pack::Scene scene = halfAbsorbingPane(size, n);
      const double error = std::abs(embreeColour(scene, "fresnel") / reference(scene)[0] - 1);
      const auto reported = bake::insufficientAbsorptionPrecision(scene.meshes[0], scene.materials[0]);
      EXPECT_EQ(reported.has_value(), n == oblique && size > 2) << size;
      EXPECT_LE(error, reported ? reported->error : bake::kAbsorptionPrecision / 10) << size;
    }
}

// A box of 2 mm with square faces of `size` metres.
TEST(ClosedForms, AbsorbingBodiesThinnerThanTheStartOfRaysAreReported) {
  const auto reported = [](double size) {
    pack::Scene scene = halfAbsorbingPane(size, {0, 1, 0});
    pack::Mesh box;
    for (const double y : {-1e-3, 1e-3})
      for (const auto& [x, z] :
           {std::pair(-0.5, -0.5), std::pair(0.5, -0.5), std::pair(0.5, 0.5), std::pair(-0.5, 0.5)})
        box.positions.emplace_back(x * size, y, z * size);
    box.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
    for (glm::uint i = 0; i < 4; ++i) {
      const glm::uint next = (i + 1) % 4;
      box.triangles.emplace_back(i, i + 4, next + 4);
      box.triangles.emplace_back(i, next + 4, next);
    }
    return bake::insufficientAbsorptionPrecision(box, scene.materials[0]);
  };
  EXPECT_FALSE(reported(2000));
  ASSERT_TRUE(reported(20000));
  EXPECT_NEAR(reported(20000)->thickness, 2e-3, 1e-5);
  EXPECT_GT(reported(20000)->distance, 2e-3);
}

TEST(ClosedForms, CameraInsideGlassReadsASkyTimesNSquared) {
  pack::Scene scene = test::emptyScene(2);
  scene.environment.radiance = glm::dvec3(1);
  scene.camera.mediumEta = kN;
  test::look(scene, {0, 0, 0}, {0, 0, -1});
  EXPECT_NEAR(reference(scene)[0], kN * kN, 1e-6);
  EXPECT_NEAR(embreeColour(scene, "fresnel"), kN * kN, 1e-6);
}

TEST(ClosedForms, DepthCountsSpecularInteractions) {
  // A mirror that sees an emitter: seen directly with depth 1, dark with depth 0.
  pack::Scene scene = glassMirror(60);
  const Powers r = fresnel(0.5, 1, kN);
  for (const std::uint32_t depth : {0u, 1u}) {
    scene.depth = depth;
    EXPECT_NEAR(reference(scene)[0], depth * (r.s + r.p) / 2, 1e-6);
    EXPECT_NEAR(embreeStokes(scene)[0], depth * (r.s + r.p) / 2, 1e-6);
  }
}

// A glossy painted floor, a tilted pane and gold on both sides, 24 x 24 pixels.
pack::Scene paintGlassAndGold() {
  pack::Scene scene = test::emptyScene(5);
  scene.width = scene.height = 24;
  scene.camera.verticalFovDegrees = 60;
  scene.environment.radiance = {0.5, 0.7, 1};
  pack::Material paint = test::dielectric(MaterialKind::paint, kN, 0.5);
  paint.highlightStrength = 1;
  paint.highlightExponent = 60;
  const auto floor = test::addMaterial(scene, paint),
             glass = test::addMaterial(scene, test::dielectric(MaterialKind::glass, kN)),
             gold = test::addMaterial(scene, test::metal({0.2, 0.5, 1.3}, {3, 2, 2}));
  test::addSquare(scene, floor, {0, -1, 0}, {0, 1, 0}, 4);
  test::addSquare(scene, glass, {0, 0, 0}, {0, 0.3, 1}, 1);
  test::addSquare(scene, glass, {0, 0, -0.1}, {0, -0.3, -1}, 1);
  test::addSquare(scene, gold, {-2, 0, 0}, {1, 0, 0.2}, 2);
  test::addSquare(scene, gold, {2, 0, 0}, {-1, 0, 0.2}, 2);
  scene.lights.push_back({{1, 3, 2}, {5, 5, 5}});
  test::look(scene, {0.5, 0.3, 4}, {0, 0, 0});
  return scene;
}

// Fairness of every comparison: without polarization-dependent branching all methods send the same rays.
TEST(ClosedForms, EveryMethodTracesTheSameRays) {
  const pack::Scene scene = paintGlassAndGold();
  embree::Renderer renderer(scene, 1);
  const std::uint64_t rays = renderer.render("schlick", render::defaultParameters(scene)).cost.rays;
  EXPECT_GT(rays, 24u * 24u * 3u);
  for (const std::string& method : render::methodNames())
    EXPECT_EQ(renderer.render(method, render::defaultParameters(scene)).cost.rays, rays) << method;
}

TEST(ClosedForms, LoopsEqualTheirRecursions) {
  const pack::Scene scene = paintGlassAndGold();
  embree::Renderer renderer(scene, 1);
  render::RenderParameters parameters = render::defaultParameters(scene);
  for (const render::Analyser& analyser :
       {render::kNoFilter, render::linearPolarizer(40), render::circularAnalyser(render::Handedness::left)}) {
    parameters.analyser = analyser;
    for (const auto& [loop, recursive] :
         {std::pair("schlick-iterative", "schlick"), {"fresnel-iterative", "fresnel"}, {"importance", "stokes"}}) {
      const render::RenderResult a = renderer.render(loop, parameters), b = renderer.render(recursive, parameters);
      double sum = 0;
      for (std::size_t i = 0; i < 24u * 24u; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(a.pixels[3 * i + c], b.pixels[i * b.channels + c], 4e-6) << loop;
          sum += b.pixels[i * b.channels + c];
        }
      EXPECT_GT(sum, 100);
    }
  }
}

TEST(ClosedForms, EmittersShineOnTheirFrontOnly) {
  for (const double z : {1.0, -1.0}) {
    pack::Scene scene = test::emptyScene(1);
    test::addMaterial(scene, test::emitter({3, 2, 1}));
    test::addSquare(scene, 0, {0, 0, -5}, {0, 0, z}, 1);
    test::look(scene, {0, 0, 0}, {0, 0, -1});
    EXPECT_FLOAT_EQ(static_cast<float>(embreeColour(scene, "schlick")), z > 0 ? 2.0f : 0.0f);
    EXPECT_NEAR(reference(scene)[0], z > 0 ? 2 : 0, 1e-6);
  }
}

TEST(ClosedForms, HighlightIsTheLobeTimesTheReflectance) {
  pack::Scene scene = glassMirror(45);
  scene.environment.radiance = glm::dvec3(0);
  scene.materials[0].highlightStrength = 1;
  scene.materials[0].highlightExponent = 50;
  scene.lights.push_back({{0, std::sqrt(2.0), -std::sqrt(2.0)}, {4, 4, 4}});  // in the mirror direction, 2 m away
  const Powers r = fresnel(std::sqrt(0.5), 1, kN);
  const double arriving = 4.0 / 4 * 51 / (2 * std::numbers::pi);
  const glm::dvec4 light = reference(scene);
  EXPECT_NEAR(light[0], arriving * (r.s + r.p) / 2, 1e-5);
  EXPECT_NEAR(light[1], arriving * (r.s - r.p) / 2, 1e-5);
  EXPECT_NEAR(embreeStokes(scene)[0], light[0], 1e-5);
}

// The scene of a glTF pane without a volume in front of a panel of radiance 1, seen at normal incidence.
pack::Scene importedPane(const nlohmann::json& material, bool isOpenSurface) {
  prep::Mesh square;
  square.positions = {{-1, -1.1, 0}, {1.2, -1.1, 0}, {1.2, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  prep::test::GltfFile gltf;
  gltf.document["materials"] = {material};
  gltf.addMesh(square, "pane", 0);
  gltf.addNode({{"name", "pane"}, {"mesh", 0}});
  const bake::test::TemporaryFolder folder;
  folder.write("pane.glb", gltf.glb());
  folder.write("panel.obj", bake::test::kSquareObj);
  nlohmann::json scene = nlohmann::json::parse(R"({
    "malus": 1, "name": "pane", "resolution": [1, 1], "depth": 8,
    "camera": {"position": [0.1, 0.2, 2], "target": [0.1, 0.2, 0], "verticalFovDegrees": 0.1},
    "materials": {"lamp": {"type": "emitter", "radiance": [1, 1, 1]}},
    "meshes": [{"name": "panel", "file": "panel.obj", "material": "lamp",
                "instances": [{"scale": 8, "rotateDegrees": [90, 0, 0], "translate": [0, 0, -1]}]}],
    "imports": [{"file": "pane.glb"}]})");
  if (isOpenSurface) scene["imports"][0]["openSurfaces"] = {"pane"};
  return bake::bake(bake::readSceneFile(folder.write("scene.json", scene.dump())), {}, [](std::string_view) {}).scene;
}

TEST(ClosedForms, ThinWalledTransmissionOfGltfIsAPane) {
  // T' = T^2 a / (1 - R^2 a^2) with R = ((n - 1) / (n + 1))^2, T = 1 - R, and the base colour a.
  nlohmann::json material = nlohmann::json::parse(R"({"name": "window",
    "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
    "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})");
  const auto expectPane = [&](double n, const glm::dvec3& colour) {
    for (const bool isOpenSurface : {false, true}) {
      const pack::Scene scene = importedPane(material, isOpenSurface);
      EXPECT_EQ(scene.materials.back().kind, MaterialKind::thinGlass);
      const render::RenderParameters parameters = render::defaultParameters(scene);
      const render::RenderResult truth = reference::render(scene, parameters, 1),
                                 fast = embree::Renderer(scene, 1).render("stokes", parameters);
      const double r = std::pow((n - 1) / (n + 1), 2);
      for (int c = 0; c < 3; ++c) {
        const double expected = std::pow(1 - r, 2) * colour[c] / (1 - r * r * colour[c] * colour[c]);
        EXPECT_NEAR(truth.pixels[static_cast<std::size_t>(c)], expected, 1e-6) << c;
        EXPECT_NEAR(fast.pixels[static_cast<std::size_t>(c)], expected, 2e-6) << c;
      }
    }
  };
  expectPane(1.5, glm::dvec3(1));  // 12 / 13
  material["extensions"]["KHR_materials_ior"] = {{"ior", 2}};
  material["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 0}, {"attenuationDistance", 0.1}};
  material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0.5, 0.125, 1};
  expectPane(2, {1, 0.5, 0.125});
}

}  // namespace
}  // namespace malus
