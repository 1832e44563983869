// The scenes of scenes/hard: rendered without unphysical values (every method on Embree,
// `stokes` and `importance` on Vulkan), they agree, and the centre pixel has its closed form where there is one. Each
// scene's README describes the failure that it provokes and the source of the numbers.
#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/pack/reader.h"
#include "meshprep/base/atomic_file.h"
#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/scene/effects_choice.h"
#include "render/scene/methods.h"
#include "render/vulkan/renderer.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

namespace fs = std::filesystem;
using Colours = std::array<double, 3>;
using render::RenderResult;

// Bounds of a scene, from tolerances.json, which gpu-check uses too. Pixels count as outliers if a component of a
// Stokes vector differs by more than `threshold`; edges and magnified roundings explain `outliers` of them.
struct Expected {
  double threshold = 1e-4;
  std::size_t outliers = 0;
  bool renderersAgree = true;  // Vulkan with the others
};
const std::map<std::string, Expected>& scenes() {
  static const std::map<std::string, Expected> kScenes = [] {
    const nlohmann::json document = nlohmann::json::parse(readTextFile(MALUS_TOLERANCES));
    std::map<std::string, Expected> result;
    for (const auto& [name, entry] : document.items())
      result[name] = {entry.at("threshold").get<double>(), entry.at("outliers").get<std::size_t>(),
                      entry.value("renderersAgree", true)};
    return result;
  }();
  return kScenes;
}

// A scene after baking, writing and reading.
const pack::Pack& bakedPack(const std::string& name) {
  static std::map<std::string, pack::Pack> packs;
  const auto at = packs.find(name);
  if (at != packs.end()) return at->second;
  const pack::WriteSettings settings;
  const fs::path file = fs::path(MALUS_SCENES) / "hard" / name / "scene.json";
  const bake::Baked baked = bake::bake(bake::readSceneFile(file), settings, [](std::string_view) {});
  return packs.emplace(name, pack::parse(pack::serialize(baked.scene, settings).bytes, name)).first->second;
}
render::RenderParameters checkedParameters(const pack::Scene& scene) {
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.checkNumerics = true;
  return parameters;
}

void expectSound(const RenderResult& image, const pack::Scene& scene, const std::string& what) {
  EXPECT_EQ(image.faults.count, 0u) << what << ": " << describe(image.faults, scene);
  for (const float v : image.pixels) ASSERT_TRUE(std::isfinite(v)) << what;
}

// Images of the reference and of both renderers with `stokes`, each rendered and checked once.
struct Images {
  RenderResult reference, embree, vulkan;
};
const Images& renderedImages(const std::string& name) {
  static std::map<std::string, Images> all;
  const auto at = all.find(name);
  if (at != all.end()) return at->second;
  const pack::Scene& scene = bakedPack(name).scene;
  const render::RenderParameters parameters = checkedParameters(scene);
  Images p;
  p.reference = reference::render(scene, parameters, 0);
  expectSound(p.reference, scene, name + ", reference");
  p.embree = embree::Renderer(scene, 0).render("stokes", parameters);
  expectSound(p.embree, scene, name + ", embree stokes");
  p.vulkan = vulkan::Renderer(scene, {}).render("stokes", parameters);
  expectSound(p.vulkan, scene, name + ", vulkan stokes");
  return all.emplace(name, std::move(p)).first->second;
}

// S0..S3 of a pixel, per colour.
std::array<Colours, 4> stokesAt(const RenderResult& p, std::size_t x, std::size_t y) {
  std::array<Colours, 4> s{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 3; ++c) s[k][c] = p.pixels[(y * p.width + x) * p.channels + 3 + 3 * k + c];
  return s;
}
std::array<Colours, 4> centrePixel(const RenderResult& p) { return stokesAt(p, p.width / 2, p.height / 2); }

std::size_t pixelsOff(const RenderResult& a, const RenderResult& b, double threshold, double& largest) {
  std::size_t off = 0;
  largest = 0;
  for (std::size_t y = 0; y < a.height; ++y)
    for (std::size_t x = 0; x < a.width; ++x) {
      const auto s = stokesAt(a, x, y), t = stokesAt(b, x, y);
      double d = 0;
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t c = 0; c < 3; ++c) d = std::max(d, std::abs(s[k][c] - t[k][c]));
      largest = std::max(largest, d);
      if (d > threshold) ++off;
    }
  return off;
}

class HardScenes : public testing::TestWithParam<std::string> {};

TEST_P(HardScenes, RenderersAgreeWithTheReference) {
  const Images& p = renderedImages(GetParam());
  const Expected& expected = scenes().at(GetParam());
  const auto expectClose = [&](const RenderResult& a, const char* what) {
    ASSERT_EQ(a.pixels.size(), p.reference.pixels.size()) << what;
    double largest = 0;
    EXPECT_LE(pixelsOff(a, p.reference, expected.threshold, largest), expected.outliers)
        << what << ", largest difference " << largest;
  };
  expectClose(p.embree, "embree");
  if (expected.renderersAgree) expectClose(p.vulkan, "vulkan");
  // The image is not empty.
  EXPECT_GT(*std::max_element(p.reference.pixels.begin(), p.reference.pixels.end()), 0.01f);
}

TEST_P(HardScenes, EveryMethodIsSound) {
  const pack::Scene& scene = bakedPack(GetParam()).scene;
  embree::Renderer renderer(scene, 0);
  for (const std::string& method : render::methodNames())
    expectSound(renderer.render(method, checkedParameters(scene)), scene, "embree " + method);
}

// The intensity by the cheapest method that the effects allow, against full Stokes vectors with everything compiled in.
TEST_P(HardScenes, AutoEqualsAll) {
  const pack::Scene& scene = bakedPack(GetParam()).scene;
  render::RenderParameters parameters = render::defaultParameters(scene);
  embree::Renderer embree(scene, 0);
  vulkan::Renderer vulkan(scene, {});
  for (const render::Analyser& analyser : {render::kNoFilter, render::linearPolarizer(30)}) {
    parameters.analyser = analyser;
    const bake::ImageRequest request{parameters.depth, analyser, false, false};
    for (const std::string method : {"stokes", "importance"}) {
      const std::string cheaper = render::chooseEffects({"auto"}, method, scene, request).method;
      const auto expectEqual = [&](const RenderResult& a, const RenderResult& b, const char* what) {
        double largest = 0;
        for (std::size_t i = 0; i < std::size_t{a.width} * a.height; ++i)
          for (std::size_t c = 0; c < 3; ++c)
            largest = std::max(
                largest, std::abs(static_cast<double>(a.pixels[i * a.channels + c] - b.pixels[i * b.channels + c])));
        EXPECT_LT(largest, 4e-6) << what << ": " << cheaper << " instead of " << method;
      };
      parameters.everyEffect = true;
      const RenderResult all = embree.render(method, parameters);
      const RenderResult allVulkan = vulkan.render(method, parameters);
      parameters.everyEffect = false;
      expectEqual(embree.render(cheaper, parameters), all, "embree");
      expectEqual(vulkan.render(cheaper, parameters), allVulkan, "vulkan");
    }
  }
}

// Every method renders the same image with the smallest sufficient build and with the build of all effects.
TEST_P(HardScenes, EveryMethodIsTheSameInEveryBuild) {
  const pack::Scene& scene = bakedPack(GetParam()).scene;
  embree::Renderer renderer(scene, 0);
  render::RenderParameters parameters = render::defaultParameters(scene);
  for (const std::string& method : render::methodNames()) {
    parameters.everyEffect = false;
    const RenderResult some = renderer.render(method, parameters);
    parameters.everyEffect = true;
    const RenderResult all = renderer.render(method, parameters);
    double largest = 0;
    for (std::size_t i = 0; i < all.pixels.size(); ++i)
      largest = std::max(largest, std::abs(static_cast<double>(all.pixels[i] - some.pixels[i])));
    EXPECT_LT(largest, 4e-6) << method;
  }
}

TEST_P(HardScenes, ImportanceIsTheIntensityOfTheReference) {
  // Also behind filters, and on Vulkan at any depth, because the iterative method does not recurse.
  const pack::Scene& scene = bakedPack(GetParam()).scene;
  const Expected& expected = scenes().at(GetParam());
  render::RenderParameters parameters = checkedParameters(scene);
  embree::Renderer embree(scene, 0);
  vulkan::Renderer vulkan(scene, {});
  for (const render::Analyser& analyser : {render::kNoFilter, render::linearPolarizer(30),
                                           render::behindWavePlate(render::linearPolarizer(75), {20, 90})}) {
    parameters.analyser = analyser;
    const RenderResult truth = reference::render(scene, parameters, 0);
    const auto expectClose = [&](const RenderResult& p, const char* what) {
      expectSound(p, scene, what);
      std::size_t off = 0;
      for (std::size_t i = 0; i < std::size_t{p.width} * p.height; ++i) {
        double d = 0;
        for (std::size_t c = 0; c < 3; ++c)
          d = std::max(d, std::abs(static_cast<double>(p.pixels[3 * i + c] - truth.pixels[i * truth.channels + c])));
        if (d > expected.threshold) ++off;
      }
      EXPECT_LE(off, expected.outliers) << what;
    };
    expectClose(embree.render("importance", parameters), "embree importance");
    if (expected.renderersAgree) expectClose(vulkan.render("importance", parameters), "vulkan importance");
  }
}

// With four analysers the iterative method gives Stokes vectors. S1 to S3 are differences of two intensities of up to
// twice S0.
TEST_P(HardScenes, ImportanceGivesTheStokesVectorsOfTheReference) {
  const Expected& expected = scenes().at(GetParam());
  const pack::Scene& scene = bakedPack(GetParam()).scene;
  render::RenderParameters parameters = checkedParameters(scene);
  parameters.stokes = true;
  const RenderResult image = embree::Renderer(scene, 0).render("importance", parameters);
  expectSound(image, scene, GetParam() + ", importance");
  const RenderResult& truth = renderedImages(GetParam()).reference;
  ASSERT_EQ(image.pixels.size(), truth.pixels.size());
  double largest = 0;
  EXPECT_LE(pixelsOff(image, truth, expected.threshold, largest), expected.outliers) << largest;
}

std::string testName(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& [name, expected] : scenes()) names.push_back(name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, HardScenes, testing::ValuesIn(sceneNames()), testName);

TEST(HardScene, EveryFolderIsListed) {
  std::set<std::string> folders;
  for (const auto& entry : fs::directory_iterator(fs::path(MALUS_SCENES) / "hard"))
    folders.insert(entry.path().filename());
  const std::vector<std::string> names = sceneNames();
  EXPECT_EQ(folders, (std::set<std::string>(names.begin(), names.end())));
}

// Scenes in which polarization is not visible, so that auto selects another method: a convex body with smooth normals,
// albedo and a highlight; a flat mirror.
pack::Scene withoutMutualSight(bool flat, pack::MaterialKind kind) {
  pack::Scene scene = test::emptyScene(6);
  scene.width = scene.height = 48;
  scene.camera.verticalFovDegrees = 40;
  scene.environment.radiance = {0.3, 0.5, 0.8};
  pack::Material m = kind == pack::MaterialKind::metal ? test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9})
                                                       : test::dielectric(kind, 1.5);
  m.albedo = glm::dvec3(0.4);
  m.highlightStrength = 1;
  m.highlightExponent = 40;
  test::addMaterial(scene, m);
  pack::Material ground;
  ground.albedo = glm::dvec3(0.5);
  test::addMaterial(scene, ground);
  if (flat) {
    test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 1);
  } else {
    // A ball of longitudes and latitudes.
    pack::Mesh ball;
    ball.name = "ball";
    constexpr std::uint32_t kRings = 10, kSpokes = 16;
    for (std::uint32_t i = 0; i <= kRings; ++i)
      for (std::uint32_t j = 0; j < kSpokes; ++j) {
        const double theta = std::numbers::pi * i / kRings, phi = 2 * std::numbers::pi * j / kSpokes;
        const double ring = i == 0 || i == kRings ? 0 : std::sin(theta);
        ball.normals.emplace_back(ring * std::cos(phi),
                                  i == 0        ? 1
                                  : i == kRings ? -1
                                                : std::cos(theta),
                                  ring * std::sin(phi));
        ball.positions.push_back(ball.normals.back());
      }
    for (std::uint32_t i = 0; i < kRings; ++i)
      for (std::uint32_t j = 0; j < kSpokes; ++j) {
        const std::uint32_t a = i * kSpokes + j, b = i * kSpokes + (j + 1) % kSpokes;
        if (i > 0) ball.triangles.emplace_back(a, b, b + kSpokes);
        if (i + 1 < kRings) ball.triangles.emplace_back(a, b + kSpokes, a + kSpokes);
      }
    scene.meshes.push_back(ball);
  }
  test::addSquare(scene, 1, {0, -2, 0}, {0, 1, 0}, 4);
  scene.lights.push_back({{3, 4, 2}, {20, 20, 20}});
  test::look(scene, {0.5, 1.5, 4}, {0, 0, 0});
  return scene;
}

TEST(HardScene, AutoIsExactIfPolarizationIsNotVisible) {
  for (const bool flat : {false, true})
    for (const pack::MaterialKind kind :
         {pack::MaterialKind::metal, pack::MaterialKind::paint, pack::MaterialKind::mirrorGlass}) {
      const pack::Scene scene = withoutMutualSight(flat, kind);
      const render::RenderParameters parameters = render::defaultParameters(scene);
      const bake::ImageRequest request{parameters.depth, parameters.analyser, false, false};
      SCOPED_TRACE(testing::Message() << (flat ? "flat " : "ball ") << pack::materialKindName(kind));
      EXPECT_EQ(render::chooseEffects({"auto"}, "stokes", scene, request).method, "fresnel");
      EXPECT_EQ(render::chooseEffects({"auto"}, "importance", scene, request).method, "fresnel-iterative");
      const RenderResult truth = reference::render(scene, parameters, 0);
      embree::Renderer embree(scene, 0);
      vulkan::Renderer vulkan(scene, {});
      for (const char* method : {"fresnel", "fresnel-iterative"})
        for (const RenderResult& p : {embree.render(method, parameters), vulkan.render(method, parameters)}) {
          std::size_t off = 0;
          double sum = 0;
          for (std::size_t i = 0; i < std::size_t{p.width} * p.height; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
              const double want = truth.pixels[i * truth.channels + c];
              if (std::abs(p.pixels[3 * i + c] - want) > 1e-4) ++off;
              sum += want;
            }
          EXPECT_LE(off, 6u) << method;  // two pixels of an edge
          EXPECT_GT(sum, 100);
        }
    }
}

// Closed forms at the centre pixel, with six digits as in the READMEs.
void expectCentre(const std::string& name, const std::vector<Colours>& stokes, double tolerance = 2e-6) {
  const Images& p = renderedImages(name);
  for (const RenderResult* image : {&p.reference, &p.embree, &p.vulkan}) {
    const char* what = image == &p.reference ? "reference" : image == &p.embree ? "embree" : "vulkan";
    const auto centre = centrePixel(*image);
    for (std::size_t k = 0; k < stokes.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(centre[k][c], stokes[k][c], tolerance) << name << ", " << what << ", S" << k << ", colour " << c;
  }
}
Colours grey(double v) { return {v, v, v}; }

TEST(HardScene, CrossedBrewsterMirrorsExtinguish) {
  const Images& p = renderedImages("brewster-pair");
  for (const RenderResult* image : {&p.reference, &p.embree, &p.vulkan}) {
    const double parallel = stokesAt(*image, 8, 33)[0][1];
    EXPECT_NEAR(parallel, 0.010941, 5e-6);
    const Colours dark = centrePixel(*image)[0];
    for (const double v : dark) EXPECT_LT(std::abs(v), 1e-6 * parallel);
  }
}

TEST(HardScene, CircularPolarizationIsRequired) {
  expectCentre("gold-periscope", {{.761783, .292732, .046903},
                                  {.014892, -.000063, .006338},
                                  {.052014, .053637, .017169},
                                  {-.010621, -.066356, -.029755}});
  expectCentre("glass-gold-gold-glass", {grey(0), grey(0), grey(0), grey(0)}, 1e-8);
  // Without S3 the periscope is too bright in blue, and the dark scene is not dark.
  const auto linear = [](const std::string& name) {
    const pack::Scene& scene = bakedPack(name).scene;
    return centrePixel(embree::Renderer(scene, 0).render("stokes-linear", render::defaultParameters(scene)))[0];
  };
  EXPECT_NEAR(linear("gold-periscope")[2], .058156, 2e-6);
  EXPECT_NEAR(linear("glass-gold-gold-glass")[0], .004326, 2e-6);
  expectCentre("fresnel-rhomb", {grey(.068166), grey(0), grey(0), grey(-.068166)});
}

TEST(HardScene, ChainsOfMirrors) {
  expectCentre("mirror-loop", {grey(.073964), grey(-.073964), grey(0), grey(0)});
  // After 64 bounces, float directions differ by 1e-5.
  expectCentre("facing-mirrors", {{.466385, .272120, .156730}, {.052601, .044035, .032180}}, 2e-5);
  const pack::Scene& scene = bakedPack("facing-mirrors").scene;
  const auto centre = centrePixel(renderedImages("facing-mirrors").reference);
  EXPECT_NEAR(centre[0][0], .466385, 2e-6);
  // The depth exceeds lavapipe's recursion limit: a stack replaces the recursion. At the limit the methods recurse.
  vulkan::Renderer renderer(scene, {});
  render::RenderParameters parameters = checkedParameters(scene);
  EXPECT_EQ(parameters.depth, 64u);
  for (const std::uint32_t depth : {64u, 29u}) {
    parameters.depth = depth;
    const RenderResult a = renderer.render("stokes", parameters), b = reference::render(scene, parameters, 0);
    EXPECT_EQ(a.withoutRecursion.empty(), depth == 29u) << a.withoutRecursion;
    expectSound(a, scene, fmt::format("vulkan at depth {}", depth));
    double largest = 0;
    EXPECT_EQ(pixelsOff(a, b, 1e-4, largest), 0u) << largest;
  }
}

TEST(HardScene, GlassAndMedia) {
  expectCentre("paint-under-glass-in-brewster-mirror", {grey(.007915), grey(.007915), grey(0), grey(0)});
  expectCentre("glass-slab", {grey(.848128), grey(-.148274), grey(0), grey(0)});
  expectCentre("thin-slab", {{.863316, .611914, .362032}});
  expectCentre("inside-glass", {grey(2.25)});
  expectCentre("nested-media", {grey(.916946)});
  expectCentre("camera-on-surface", {grey(2.163462)});
}

TEST(HardScene, NoLeaksThroughEdgesFromInside) {
  // The middle column, whose rays hit the edge, shows the panel or black, never the sky.
  const Images& p = renderedImages("into-the-edge");
  for (const RenderResult* image : {&p.reference, &p.embree, &p.vulkan})
    for (std::size_t y = 0; y < image->height; ++y) {
      const auto s = stokesAt(*image, image->width / 2, y), beside = stokesAt(*image, image->width / 2 + 2, y);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(s[0][c], beside[0][c], 1e-3) << "row " << y;
    }
}

TEST(HardScene, ScaleAndPositionDoNotMatter) {
  // One scene at 1 m, translated by 1e5 m, and of size 1e-5 m: the grid rounds differently, edges may move by a pixel.
  const Images& room = renderedImages("room");
  for (const std::string name : {"far-away", "tiny"}) {
    const Images& other = renderedImages(name);
    double largest = 0;
    EXPECT_LE(pixelsOff(room.reference, other.reference, 1e-3, largest), 4u) << name << ' ' << largest;
    EXPECT_LE(pixelsOff(room.embree, other.embree, 1e-3, largest), 4u) << name << ' ' << largest;
    EXPECT_LE(pixelsOff(room.vulkan, other.vulkan, 1e-3, largest), 4u) << name << ' ' << largest;
  }
}

TEST(HardScene, SliversDoNotMatter) {
  const Images& p = renderedImages("slivers");
  for (const RenderResult* image : {&p.reference, &p.embree, &p.vulkan}) {
    const std::size_t y = image->height / 2;
    for (std::size_t x = 8; x + 8 < image->width; ++x) {
      const double above = stokesAt(*image, x, y - 1)[0][1], below = stokesAt(*image, x, y + 1)[0][1];
      const double here = stokesAt(*image, x, y)[0][1];
      EXPECT_GE(here, std::min(above, below) - 1e-4) << x;
      EXPECT_LE(here, std::max(above, below) + 1e-4) << x;
    }
  }
}

TEST(HardScene, CoincidentFacesStayWithinBounds) {
  const Images& p = renderedImages("touching-bodies");
  for (const RenderResult* image : {&p.reference, &p.embree, &p.vulkan})
    for (std::size_t y = 0; y < image->height; ++y)
      for (std::size_t x = 0; x < image->width; ++x) {
        const Colours s0 = stokesAt(*image, x, y)[0];
        for (const double v : s0) {
          EXPECT_GE(v, 0);
          EXPECT_LE(v, 1 + 1e-6);
        }
      }
}

}  // namespace
}  // namespace malus
