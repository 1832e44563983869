// The validation layers report what the other tests rely on, and find nothing in a render.
//
// GPU-assisted validation (MALUS_VALIDATION=gpu) instruments all shaders. With version 1.3.239 of the layer and
// lavapipe the reports of compute shaders arrive. Stages of ray-tracing pipelines are instrumented too
// (MESA_SPIRV_DUMP_PATH shows checks that write to descriptor set 7), but their reports do not arrive: a render with
// more point lights than were uploaded gives no message. FindsNothingInRenders therefore tests only that instrumented
// pipelines work.
#include <cstdlib>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/vulkan/renderer.h"
#include "tests/render/vulkan/compute_program.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::vulkan {
namespace {

// The first message of the layers; empty: none.
std::string firstMessage(const Instance& instance) {
  try {
    instance.requireNoMessages();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(VulkanValidation, FindsMissingBarriers) {
  const Instance instance(0);
  ASSERT_TRUE(instance.isValidating());
  const Device device(instance, "");
  constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  const Buffer a(device, "a", 64, kCopied, kDeviceMemory), b(device, "b", 64, kCopied, kDeviceMemory);
  device.submit("copy and back", [&](VkCommandBuffer commands) {
    const VkBufferCopy copy{0, 0, 64};
    vkCmdCopyBuffer(commands, a.get(), b.get(), 1, &copy);
    vkCmdCopyBuffer(commands, b.get(), a.get(), 1, &copy);
  });
  EXPECT_NE(firstMessage(instance).find("SYNC-HAZARD-READ-AFTER-WRITE"), std::string::npos);
}

TEST(VulkanValidation, FindsWritesOutsideABuffer) {
  const char* const variable = std::getenv("MALUS_VALIDATION");
  if (!variable || variable != std::string_view("gpu")) GTEST_SKIP() << "needs GPU-assisted validation";
  const Instance instance(0);
  const Device device(instance, "");
  const Buffer buffer(device, "values", 64, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kDeviceMemory);
  test::ComputeProgram(device, R"(#version 460
    layout(set = 0, binding = 0) buffer Values { float values[]; };
    void main() { values[gl_WorkGroupID.x + 15u] = 1.0; })",
                       buffer)
      .dispatch();
  EXPECT_EQ(firstMessage(instance), "");
  test::ComputeProgram(device, R"(#version 460
    layout(set = 0, binding = 0) buffer Values { float values[]; };
    void main() { values[gl_WorkGroupID.x + 16u] = 1.0; })",
                       buffer)
      .dispatch();
  EXPECT_NE(firstMessage(instance).find("out of bounds"), std::string::npos) << firstMessage(instance);
}

TEST(VulkanValidation, FindsNothingInRenders) {
  pack::Scene scene = test::goldAndPaintScene();
  scene.width = scene.height = 8;
  Renderer renderer(scene, {});
  for (const char* method : {"stokes", "importance"})
    EXPECT_NO_THROW(renderer.render(method, render::defaultParameters(scene))) << method;
}

}  // namespace
}  // namespace malus::vulkan
