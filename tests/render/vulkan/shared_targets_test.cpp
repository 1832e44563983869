// Images that a renderer leaves in memory which another VkDevice of the same GPU exported.
#include "render/vulkan/shared_targets.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "render/vulkan/renderer.h"
#include "tests/render/vulkan/limits.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::vulkan {
namespace {

// The device of a display: a buffer whose memory it exports and, on lavapipe, maps.
class Exporter {
 public:
  explicit Exporter(std::size_t count) : instance_(0), device_(instance_, "", {.importsMemory = true}) {
    VkDevice device = device_.get();
    VkExternalMemoryBufferCreateInfo external{VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO};
    external.handleTypes = kSharedHandle;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, &external};
    info.size = count * sizeof(float);
    info.usage = kSharedUsage;
    buffer_ = create(device, vkCreateBuffer, info, vkDestroyBuffer, "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device, buffer_.get(), &needs);
    VkExportMemoryAllocateInfo exported{VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO};
    exported.handleTypes = kSharedHandle;
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, &exported};
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags};
    allocation.allocationSize = needs.size;
    memory_ = create(device, vkAllocateMemory, allocation, vkFreeMemory, "vkAllocateMemory");
    check(vkBindBufferMemory(device, buffer_.get(), memory_.get(), 0), "vkBindBufferMemory");
    void* mapped = nullptr;
    check(vkMapMemory(device, memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    values_ = {static_cast<float*>(mapped), count};

    shared = std::make_shared<render::SharedPixels>();
    shared->deviceUUID = device_.capabilities().deviceUUID;
    shared->driverUUID = device_.capabilities().driverUUID;
    shared->bufferBytes = info.size;
    shared->allocationBytes = needs.size;
    shared->exportMemory = [this] {
      VkMemoryGetFdInfoKHR get{VK_STRUCTURE_TYPE_MEMORY_GET_FD_INFO_KHR, nullptr, memory_.get(), kSharedHandle};
      const auto function =
          reinterpret_cast<PFN_vkGetMemoryFdKHR>(vkGetDeviceProcAddr(device_.get(), "vkGetMemoryFdKHR"));
      int file = -1;
      check(function(device_.get(), &get, &file), "vkGetMemoryFdKHR");
      return file;
    };
  }

  std::span<float> values() { return values_; }
  std::shared_ptr<render::SharedPixels> shared;

 private:
  Instance instance_;
  Device device_;
  Owned<VkDeviceMemory> memory_;
  Owned<VkBuffer> buffer_;
  std::span<float> values_;
};

class SharedTargetsTest : public testing::Test {
 protected:
  SharedTargetsTest() : scene(test::goldAndPaintScene()) {
    scene.width = 40;
    scene.height = 30;
    parameters = render::defaultParameters(scene);
  }
  Renderer makeRenderer() const { return {scene, {.sharesPixels = true}}; }

  pack::Scene scene;
  render::RenderParameters parameters;
};

TEST_F(SharedTargetsTest, ContainTheImageOfRender) {
  Renderer renderer = makeRenderer();
  for (const char* method : {"stokes", "schlick", "sp"}) {
    SCOPED_TRACE(method);
    const render::RenderResult whole = renderer.render(method, parameters);
    const std::size_t count = whole.pixels.size(), before = 100;
    Exporter exporter(before + count);
    std::ranges::fill(exporter.values(), -7.0f);
    ASSERT_TRUE(renderer.acceptTarget(exporter.shared));
    // Bands of rows, in another order than that of the image.
    for (const std::uint32_t row : {20u, 0u, 10u}) {
      render::RenderParameters band = parameters;
      band.region = {0, row, 40, 10};
      const render::RenderResult result =
          renderer.renderTo(method, band, *exporter.shared, before + std::size_t{row} * 40 * whole.channels);
      EXPECT_TRUE(result.pixels.empty());
      EXPECT_EQ(result.channels, whole.channels);
      EXPECT_EQ(result.cost.readBackMs, 0);
    }
    EXPECT_TRUE(std::ranges::all_of(exporter.values().first(before), [](float v) { return v == -7; }));
    EXPECT_TRUE(std::ranges::equal(exporter.values().subspan(before), whole.pixels));
  }
}

TEST_F(SharedTargetsTest, OfSeveralLaunches) {
  const test::Limits limits("maxRayDispatchInvocationCount=70");  // of 1200 pixels
  Renderer renderer = makeRenderer();
  const render::RenderResult whole = renderer.render("stokes", parameters);
  Exporter exporter(whole.pixels.size());
  ASSERT_TRUE(renderer.acceptTarget(exporter.shared));
  EXPECT_GE(renderer.renderTo("stokes", parameters, *exporter.shared, 0).cost.launches, 17u);
  EXPECT_TRUE(std::ranges::equal(exporter.values(), whole.pixels));
}

TEST_F(SharedTargetsTest, OfAnotherDeviceAreRejected) {
  Renderer renderer = makeRenderer();
  Exporter exporter(64);
  EXPECT_FALSE(renderer.acceptTarget(nullptr));
  for (auto member : {&render::SharedPixels::deviceUUID, &render::SharedPixels::driverUUID}) {
    render::SharedPixels other = *exporter.shared;
    (other.*member)[3] ^= 1u;
    EXPECT_FALSE(renderer.acceptTarget(std::make_shared<render::SharedPixels>(other)));
  }
  Renderer ordinary(scene, Options{});
  EXPECT_FALSE(ordinary.acceptTarget(exporter.shared));
  const test::Limits limits("VK_KHR_external_memory_fd=0");
  EXPECT_FALSE(makeRenderer().acceptTarget(exporter.shared));
}

TEST_F(SharedTargetsTest, ReleasedOnesMustBeAcceptedAgain) {
  Renderer renderer = makeRenderer();
  Exporter exporter(15 * 1200);
  ASSERT_TRUE(renderer.acceptTarget(exporter.shared));
  renderer.releaseTargets();
  EXPECT_ANY_THROW(renderer.renderTo("stokes", parameters, *exporter.shared, 0));
  ASSERT_TRUE(renderer.acceptTarget(exporter.shared));
  EXPECT_NO_THROW(renderer.renderTo("stokes", parameters, *exporter.shared, 0));
}

}  // namespace
}  // namespace malus::vulkan
