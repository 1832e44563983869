// Many small images beside other parallel work, as in the viewer: its reference occupies the threads of TBB while views
// are rendered.
#include <cstddef>
#include <cstdint>
#include <thread>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

#include <gtest/gtest.h>

#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "tests/largest_memory.h"
#include "tests/render/vulkan/scenes.h"

namespace malus {
namespace {

// Occupies the threads of TBB until it is destroyed.
class OtherWork {
 public:
  OtherWork() : thread_([this] { run(); }) {}
  ~OtherWork() {
    context_.cancel_group_execution();
    thread_.join();
  }
  OtherWork(const OtherWork&) = delete;
  OtherWork& operator=(const OtherWork&) = delete;

 private:
  void run() {
    oneapi::tbb::parallel_for(
        std::int64_t{0}, std::int64_t{1} << 60u, [](std::int64_t) {}, context_);
  }

  oneapi::tbb::task_group_context context_;
  std::thread thread_;
};

std::size_t bytesOfMoreImages(render::Renderer& renderer, const pack::Scene& scene) {
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.width = parameters.height = 48;
  parameters.region = {0, 0, 48, 48};
  const auto renderImages = [&](int count) {
    for (int i = 0; i < count; ++i) renderer.render("fresnel", parameters);
  };
  const OtherWork other;
  renderImages(300);
  const std::size_t before = test::largestMemory();
  renderImages(3000);
  return test::largestMemory() - before;
}

// An arena of TBB takes 8 KiB.
constexpr std::size_t kMost = std::size_t{4} << 20u;

TEST(ManyImages, NeedNoMoreMemoryThanOneOnEmbree) {
  const pack::Scene scene = test::goldScene();
  embree::Renderer renderer(scene, 2);
  EXPECT_LT(bytesOfMoreImages(renderer, scene), kMost);
}

TEST(ManyImages, NeedNoMoreMemoryThanOneInTheReference) {
  const pack::Scene scene = test::goldScene();
  reference::Renderer renderer(scene, 2);
  EXPECT_LT(bytesOfMoreImages(renderer, scene), kMost);
}

}  // namespace
}  // namespace malus
