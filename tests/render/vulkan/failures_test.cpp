// Makes every Vulkan call of a render that can fail do so once.
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/vulkan/renderer.h"
#include "tests/render/vulkan/scenes.h"
#include "tests/render/vulkan/vulkan_calls.h"

namespace malus::vulkan {
namespace {

struct Attempt {
  std::vector<float> pixels;                    // of the last render; empty if there is none
  std::optional<std::string> constructorError;  // messages
  std::optional<std::string> renderError;
};

// Makes a renderer and renders; if the first render fails, renders again with the same renderer.
Attempt attempt(const pack::Scene& scene) {
  Attempt result;
  std::optional<Renderer> renderer;
  try {
    renderer.emplace(scene, Options{});
  } catch (const Error& error) {
    result.constructorError = error.what();
    return result;
  }
  const render::RenderParameters parameters = render::defaultParameters(scene);
  try {
    result.pixels = renderer->render("fresnel", parameters).pixels;
  } catch (const Error& error) {
    result.renderError = error.what();
    result.pixels = renderer->render("fresnel", parameters).pixels;
  }
  return result;
}

TEST(VulkanFailures, EachIsReportedAndLeaksNothing) {
  const pack::Scene scene = test::goldAndPaintScene();
  test::watchVulkanCalls(0);
  const Attempt expected = attempt(scene);
  ASSERT_FALSE(expected.pixels.empty());
  EXPECT_TRUE(test::vulkanCalls().live.empty());
  EXPECT_TRUE(test::vulkanCalls().messages.empty());
  EXPECT_TRUE(test::vulkanCalls().unwatched.empty()) << test::vulkanCalls().unwatched.front();
  const std::size_t total = test::vulkanCalls().fallible;

  std::size_t inConstructor = 0, inRender = 0;
  for (std::size_t failAt = 1; failAt <= total; ++failAt) {
    test::watchVulkanCalls(failAt);
    const Attempt found = attempt(scene);
    const test::VulkanCalls calls = test::vulkanCalls();
    SCOPED_TRACE("call " + std::to_string(failAt) + ", " + calls.failed);
    ASSERT_FALSE(calls.failed.empty());
    ASSERT_TRUE(found.constructorError || found.renderError);
    const std::string& message = found.constructorError ? *found.constructorError : *found.renderError;
    EXPECT_NE(message.find(calls.failed), std::string::npos) << message;
    EXPECT_NE(message.find("out of device memory"), std::string::npos) << message;
    EXPECT_NE(message.find("--device"), std::string::npos) << message;
    if (calls.failed == "vkAllocateMemory") {
      for (const char* word : {"bytes) failed", "heap 0", "may use", "uses"})
        EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
    }
    EXPECT_TRUE(calls.live.empty()) << calls.live.begin()->first << ": " << calls.live.begin()->second;
    EXPECT_TRUE(calls.messages.empty()) << calls.messages.front();
    if (found.renderError) {
      EXPECT_EQ(found.pixels, expected.pixels);
    }
    ++(found.constructorError ? inConstructor : inRender);
  }
  EXPECT_GT(inConstructor, 50u);
  EXPECT_GT(inRender, 20u);

  test::watchVulkanCalls(0);
  EXPECT_EQ(attempt(scene).pixels, expected.pixels);
}

TEST(VulkanAcceleration, BottomLevelIsCompacted) {
  const pack::Scene scene = test::goldAndPaintScene();
  const std::vector<float> expected = attempt(scene).pixels;
  test::watchVulkanCalls(0);
  test::padStructures(4096);
  const std::vector<float> found = attempt(scene).pixels;
  test::padStructures(0);
  const test::VulkanCalls calls = test::vulkanCalls();
  EXPECT_EQ(calls.compactions, 1u);
  ASSERT_EQ(calls.structureBytes.size(), 3u);  // bottom level as built and compacted, top level
  EXPECT_EQ(calls.structureBytes[1] + 4096, calls.structureBytes[0]);
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(calls.live.empty());
  EXPECT_TRUE(calls.messages.empty());
}

// A scene is uploaded by one submission and its bottom levels are built by one, however many there are.
TEST(VulkanSubmissions, SceneNeedsThree) {
  for (const int squares : {1, 5}) {
    pack::Scene scene = test::goldScene();
    for (int i = 0; i < squares; ++i) {
      const glm::dvec3 centre(i + 1, 0, -1);
      test::addSquare(scene, 0, centre, {0, 0, 1}, 1);
      scene.meshes.back().origin = centre;
    }
    test::watchVulkanCalls(0);
    const Renderer renderer(scene, Options{});
    EXPECT_EQ(test::vulkanCalls().submissions, 3u) << squares;
    test::padStructures(4096);
    test::watchVulkanCalls(0);
    const Renderer compacted(scene, Options{});
    test::padStructures(0);
    EXPECT_EQ(test::vulkanCalls().compactions, squares + 1u);
    EXPECT_EQ(test::vulkanCalls().submissions, 4u) << squares;
  }
}

// An image as large as one before: a submission per launch, no new object, no change of descriptors.
TEST(VulkanSubmissions, NextImageNeedsOneForEachLaunch) {
  const pack::Scene scene = test::goldAndPaintScene();
  Renderer renderer(scene, Options{});
  const render::RenderParameters parameters = render::defaultParameters(scene);
  for (const char* method : {"fresnel", "importance"}) {
    const std::vector<float> expected = renderer.render(method, parameters).pixels;
    test::watchVulkanCalls(0);
    const render::RenderResult found = renderer.render(method, parameters);
    const test::VulkanCalls calls = test::vulkanCalls();
    EXPECT_EQ(found.pixels, expected);
    EXPECT_EQ(found.cost.launches, 1u);
    EXPECT_EQ(calls.submissions, found.cost.launches);
    EXPECT_EQ(calls.descriptorWrites, 0u);
    EXPECT_TRUE(calls.live.empty()) << calls.live.begin()->first;
    EXPECT_TRUE(calls.allocations.empty());
  }
}

}  // namespace
}  // namespace malus::vulkan
