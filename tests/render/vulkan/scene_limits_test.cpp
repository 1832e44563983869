// Scenes that exceed a limit of the device: errors that name the need and the limit.
#include <string>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/vulkan/renderer.h"
#include "tests/render/test_scene.h"
#include "tests/render/vulkan/limits.h"

namespace malus::vulkan {
namespace {

// Two squares: 8 positions of 12 bytes, 4 triangles.
pack::Scene makeScene() {
  pack::Scene scene = test::emptyScene(1);
  scene.width = scene.height = 4;
  const auto lamp = test::addMaterial(scene, test::emitter({5, 5, 5}));
  test::addSquare(scene, lamp, {0, 0, 0}, {0, 0, 1}, 1);
  test::addSquare(scene, lamp, {0, 0, -1}, {0, 0, 1}, 1);
  test::look(scene, {0, 0, 4}, {0, 0, 0});
  return scene;
}

void expectRefusal(const char* limits, std::initializer_list<const char*> words) {
  const test::Limits scope(limits);
  const pack::Scene scene = makeScene();
  try {
    Renderer(scene, {}).render("fresnel", render::defaultParameters(scene));
    ADD_FAILURE() << limits;
  } catch (const Error& error) {
    for (const char* word : words)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " in: " << error.what();
  }
}

TEST(VulkanSceneLimits, AreNamedWithTheNeed) {
  expectRefusal("maxStorageBufferRange=95",
                {"maxStorageBufferRange", "95 bytes", "'positions'", "96 bytes", "--device"});
  expectRefusal("maxMemoryAllocationSize=95", {"maxMemoryAllocationSize", "95 bytes", "--device"});
  expectRefusal("memoryHeapSize=95", {"heap 0", "95 bytes", "--device"});
  expectRefusal("maxPrimitiveCount=3", {"maxPrimitiveCount", "at most 3", "found 4", "triangles", "--device"});
  expectRefusal("maxGeometryCount=1", {"maxGeometryCount", "at most 1", "found 2", "meshes", "--device"});
}

// Stricter alignments move the records of the shader binding table and the scratch memory.
TEST(VulkanSceneLimits, AlignmentsDoNotChangeTheImage) {
  const pack::Scene scene = makeScene();
  const render::RenderParameters parameters = render::defaultParameters(scene);
  const std::vector<float> expected = Renderer(scene, {}).render("fresnel", parameters).pixels;
  const test::Limits scope(
      "shaderGroupHandleAlignment=64,shaderGroupBaseAlignment=4096,minAccelerationStructureScratchOffsetAlignment=512");
  EXPECT_EQ(Renderer(scene, {}).render("fresnel", parameters).pixels, expected);
}

}  // namespace
}  // namespace malus::vulkan
