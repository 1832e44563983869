// The forms in which the Vulkan renderer traces a method: recursion, a stack with hit records, a stack with ray
// queries. Each renders the same image; a lowered device (limits.h) takes each of them automatically.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/embree/renderer.h"
#include "render/scene/methods.h"
#include "render/vulkan/renderer.h"
#include "tests/render/test_scene.h"
#include "tests/render/vulkan/limits.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::vulkan {
namespace {

using render::RenderParameters;
using render::RenderResult;
using render::VulkanPath;

// Largest difference of any value, relative to the image's largest value.
double relativeDifference(const RenderResult& a, const RenderResult& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i) {
    EXPECT_TRUE(std::isfinite(a.pixels[i]));
    largest = std::max(largest, static_cast<double>(std::abs(a.pixels[i])));
    difference = std::max(difference, static_cast<double>(std::abs(a.pixels[i] - b.pixels[i])));
  }
  EXPECT_GT(largest, 0.1);  // the image is not black
  return difference / largest;
}

RenderParameters parametersFor(const pack::Scene& scene, VulkanPath path) {
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.vulkanPath = path;
  return parameters;
}

// Expects that a recursive method renders the same by a stack, on a device that allows no recursion, as by recursion.
// Both forms compute the same expressions in the same order, so that lavapipe's results are equal bit by bit. Without
// filtered shadows, which only the form without recursion has.
void expectSameWithoutRecursion(const pack::Scene& scene, const std::vector<std::string>& methods,
                                const std::vector<VulkanPath>& paths) {
  Renderer recursing(scene, {});
  const test::Limits limits("maxRayRecursionDepth=1");
  Renderer limited(scene, {});
  for (const std::string& method : methods) {
    SCOPED_TRACE(method);
    RenderParameters recursive = render::defaultParameters(scene);
    recursive.filteredShadows = false;
    const RenderResult expected = recursing.render(method, recursive);
    EXPECT_EQ(expected.vulkanPath, VulkanPath::pipeline);
    EXPECT_TRUE(expected.withoutRecursion.empty());
    for (const VulkanPath path : paths) {
      RenderParameters parameters = parametersFor(scene, path);
      parameters.filteredShadows = false;
      const RenderResult found = limited.render(method, parameters);
      EXPECT_EQ(found.vulkanPath, path);
      EXPECT_NE(found.withoutRecursion.find("allows 1"), std::string::npos) << found.withoutRecursion;
      EXPECT_EQ(relativeDifference(found, expected), 0) << vulkanPathName(path);
    }
  }
}

// The same of the iterative methods by both paths.
void expectSameByBothPaths(const pack::Scene& scene, const std::vector<std::string>& methods) {
  Renderer renderer(scene, {});
  for (const std::string& method : methods) {
    SCOPED_TRACE(method);
    RenderParameters byQuery = parametersFor(scene, VulkanPath::query),
                     byPipeline = parametersFor(scene, VulkanPath::pipeline);
    byQuery.stokes = byPipeline.stokes = render::methodNamed(method).hasStokes;
    const RenderResult query = renderer.render(method, byQuery), pipeline = renderer.render(method, byPipeline);
    EXPECT_EQ(query.vulkanPath, VulkanPath::query);
    EXPECT_EQ(pipeline.vulkanPath, VulkanPath::pipeline);
    EXPECT_EQ(relativeDifference(query, pipeline), 0);
  }
}

std::vector<std::string> methodsThat(bool areIterative) {
  std::vector<std::string> names;
  for (const render::MethodInfo& m : render::methods())
    if (m.isIterative == areIterative) names.push_back(m.name);
  return names;
}

TEST(VulkanPaths, IterativeMethodsRenderTheSameByBothPaths) {
  expectSameByBothPaths(test::mixedScene(), methodsThat(true));
  expectSameByBothPaths(test::everyEffectScene(), {"importance"});
}

TEST(VulkanPaths, RecursiveMethodsRenderTheSameWithoutRecursion) {
  expectSameWithoutRecursion(test::mixedScene(), methodsThat(false), {VulkanPath::pipeline, VulkanPath::query});
  expectSameWithoutRecursion(test::everyEffectScene(), {"sp-ratio", "stokes"}, {VulkanPath::pipeline});
}

TEST(VulkanPaths, EveryFormTracesTheSameRays) {
  const pack::Scene scene = test::mixedScene();
  Renderer recursing(scene, {});
  const std::uint64_t rays = recursing.countRays("fresnel", render::defaultParameters(scene));
  EXPECT_GT(rays, std::uint64_t{scene.width} * scene.height);
  const test::Limits limits("maxRayRecursionDepth=1");
  Renderer limited(scene, {});
  for (const VulkanPath path : {VulkanPath::pipeline, VulkanPath::query}) {
    EXPECT_EQ(limited.countRays("fresnel", parametersFor(scene, path)), rays);
    EXPECT_EQ(limited.countRays("fresnel-iterative", parametersFor(scene, path)), rays);
  }
}

TEST(VulkanPaths, AutomaticChoiceFollowsTheDevice) {
  pack::Scene scene = test::mixedScene();
  scene.width = scene.height = 4;
  const auto found = [&](const char* limits, const char* method) {
    const test::Limits lowered(limits);
    return Renderer(scene, {}).render(method, render::defaultParameters(scene));
  };
  EXPECT_EQ(found("", "fresnel-iterative").vulkanPath, VulkanPath::query);
  EXPECT_EQ(found("rayQuery=0", "fresnel-iterative").vulkanPath, VulkanPath::pipeline);
  EXPECT_EQ(found("VK_KHR_ray_query=0", "fresnel-iterative").vulkanPath, VulkanPath::pipeline);
  // The scene's depth is 4: the camera's ray, four more, and a shadow ray.
  EXPECT_TRUE(found("maxRayRecursionDepth=6", "fresnel").withoutRecursion.empty());
  const RenderResult limited = found("maxRayRecursionDepth=5", "fresnel"),
                     bare = found("maxRayRecursionDepth=5,rayQuery=0", "fresnel");
  EXPECT_EQ(limited.vulkanPath, VulkanPath::query);
  EXPECT_EQ(bare.vulkanPath, VulkanPath::pipeline);
  for (const RenderResult& result : {limited, bare})
    for (const char* word : {"depth 4", "6 nested rays", "allows 5"})
      EXPECT_NE(result.withoutRecursion.find(word), std::string::npos) << result.withoutRecursion;
  const test::Limits lowered("rayQuery=0");
  EXPECT_EQ(Renderer(scene, {}).vulkanPaths(), std::vector{VulkanPath::pipeline});
}

TEST(VulkanPaths, PathThatTheDeviceLacksIsRejected) {
  const pack::Scene scene = test::mixedScene();
  const auto rejection = [&](const char* limits, const char* method) -> std::string {
    const test::Limits lowered(limits);
    Renderer renderer(scene, {});
    try {
      renderer.render(method, parametersFor(scene, VulkanPath::query));
    } catch (const Error& error) {
      EXPECT_THROW(renderer.countRays(method, parametersFor(scene, VulkanPath::query)), Error);
      return error.what();
    }
    return {};
  };
  for (const char* method : {"importance", "stokes"}) {
    for (const char* word : {"--vulkan-path", "feature rayQuery", "pipeline", "--device"})
      EXPECT_NE(rejection("rayQuery=0", method).find(word), std::string::npos) << word;
    for (const char* word : {"--vulkan-path", "extension VK_KHR_ray_query"})
      EXPECT_NE(rejection("VK_KHR_ray_query=0", method).find(word), std::string::npos) << word;
  }
}

// Two gold mirrors that face each other: the camera's ray meets one after the other.
TEST(VulkanPaths, DepthOverTheRecursionLimitRenders) {
  pack::Scene scene = test::emptyScene(33);
  scene.environment.radiance = {0.2, 0.3, 0.5};
  const auto gold = test::addMaterial(scene, test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
  test::addSquare(scene, gold, {0, 0, -1}, {0, 0, 1}, 1);
  test::addSquare(scene, gold, {0, 0, 1}, {0, 0, -1}, 1);
  test::look(scene, {0, -0.99, 0.5}, {0, -0.95, -1});
  Renderer renderer(scene, {});
  embree::Renderer other(scene, 0);
  RenderParameters parameters = render::defaultParameters(scene);
  const RenderResult expected = other.render("stokes", parameters);
  EXPECT_GT(expected.cost.rays, 32u);
  for (const VulkanPath path : {VulkanPath::automatic, VulkanPath::pipeline}) {
    parameters.vulkanPath = path;
    const RenderResult found = renderer.render("stokes", parameters);
    EXPECT_NE(found.withoutRecursion.find("depth 33"), std::string::npos) << found.withoutRecursion;
    ASSERT_EQ(found.pixels.size(), expected.pixels.size());
    for (std::size_t i = 0; i < found.pixels.size(); ++i)
      EXPECT_NEAR(found.pixels[i], expected.pixels[i], 1e-5f * expected.pixels[0]);
  }
  // The check of values runs in this form too.
  parameters.checkNumerics = true;
  EXPECT_EQ(renderer.render("stokes", parameters).faults.count, 0u);
}

// Quad with the corners p, p + u, p + u + v, p + v, facing along cross(u, v).
void addQuad(pack::Scene& scene, std::uint32_t material, const glm::dvec3& p, const glm::dvec3& u,
             const glm::dvec3& v) {
  pack::Mesh mesh;
  mesh.name = "quad " + std::to_string(scene.meshes.size());
  mesh.material = material;
  mesh.openSurface = true;
  mesh.positions = {p, p + u, p + u + v, p + v};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(std::move(mesh));
}

constexpr int kPipeReflections = 196;

// A pipe of glass along -z that light crosses with that many total reflections, met at 40 degrees in a plane of
// constant y; a panel behind its far end.
pack::Scene lightPipe() {
  pack::Scene scene = test::emptyScene(200);
  const double sine = std::sin(40 * std::numbers::pi / 180), inside = sine / 1.5, width = 0.01, height = 0.1,
               length = kPipeReflections * width * std::sqrt(1 - inside * inside) / inside;
  const std::uint32_t glass = test::addMaterial(scene, test::dielectric(pack::MaterialKind::glass, 1.5));
  const std::uint32_t panel = test::addMaterial(scene, test::emitter(glm::dvec3(1)));
  const glm::dvec3 x(width, 0, 0), y(0, height, 0), z(0, 0, length), low(-width / 2, -height / 2, -length);
  addQuad(scene, glass, low + z, x, y);
  addQuad(scene, glass, low, y, x);
  addQuad(scene, glass, low, z, y);
  addQuad(scene, glass, low + x, y, z);
  addQuad(scene, glass, low, x, z);
  addQuad(scene, glass, low + y, z, x);
  test::addSquare(scene, panel, {0, 0, -length - 0.5}, {0, 0, 1}, 2);
  test::look(scene, {-0.5 * sine, 0.013, 0.5 * std::sqrt(1 - sine * sine)}, {0, 0.013, 0});
  return scene;
}

// Deeper than the depths that lavapipe recurses to: stacks, by both paths.
TEST(VulkanPaths, LightPipeAtDepth200) {
  const pack::Scene scene = lightPipe();
  // Fresnel's transmittance of the two ends; total reflections in one plane of incidence keep S0.
  const double c = std::cos(40 * std::numbers::pi / 180), t = std::sqrt(1 - (1 - c * c) / 2.25),
               rs = std::pow((c - 1.5 * t) / (c + 1.5 * t), 2), rp = std::pow((1.5 * c - t) / (1.5 * c + t), 2),
               expected = (std::pow(1 - rs, 2) + std::pow(1 - rp, 2)) / 2;
  Renderer renderer(scene, {});
  for (const char* method : {"stokes", "importance"})
    for (const VulkanPath path : {VulkanPath::query, VulkanPath::pipeline}) {
      SCOPED_TRACE(method + std::string(", ") + vulkanPathName(path));
      RenderParameters parameters = parametersFor(scene, path);
      EXPECT_NEAR(renderer.render(method, parameters).pixels[1], expected, 2e-5);
      parameters.depth = kPipeReflections + 1;  // one too few
      EXPECT_EQ(renderer.render(method, parameters).pixels[1], 0);
    }
}

}  // namespace
}  // namespace malus::vulkan
