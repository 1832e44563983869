// The cache of pipelines on disk, and pipelines that are compiled together.
#include "render/vulkan/pipeline_cache.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/atomic_file.h"
#include "render/scene/methods.h"
#include "render/vulkan/device_description.h"
#include "render/vulkan/renderer.h"
#include "tests/render/vulkan/scenes.h"
#include "tests/render/vulkan/vulkan_calls.h"

namespace malus::vulkan {
namespace {
namespace fs = std::filesystem;

// A cache folder for each test.
class VulkanPipelineCache : public testing::Test {
 protected:
  VulkanPipelineCache()
      : folder_(fs::temp_directory_path() / ("malus-pipelines-" + std::to_string(::getpid()))),
        scene_(test::goldScene()) {
    fs::create_directories(folder_);
    ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    test::watchVulkanCalls(0);
  }
  ~VulkanPipelineCache() override {
    ::unsetenv("XDG_CACHE_HOME");
    fs::remove_all(folder_);
  }

  std::vector<float> render(const char* method = "fresnel") {
    return Renderer(scene_, {}).render(method, render::defaultParameters(scene_)).pixels;
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> result;
    for (const auto& entry : fs::directory_iterator(folder_ / "malus/pipelines")) result.push_back(entry.path());
    return result;
  }

  fs::path folder_;
  pack::Scene scene_;
};

TEST_F(VulkanPipelineCache, IsReadByTheNextRun) {
  const std::vector<float> expected = render();
  ASSERT_EQ(files().size(), 1u);
  const std::uintmax_t bytes = fs::file_size(files().front());
  ASSERT_GE(bytes, 32u + 8);  // the header of the specification, to which lavapipe adds nothing, and the hash
  const auto written = fs::last_write_time(files().front());
  EXPECT_EQ(render(), expected);
  EXPECT_EQ(test::vulkanCalls().pipelineCacheBytes, (std::vector<std::size_t>{0, bytes - 8}));
  EXPECT_EQ(fs::last_write_time(files().front()), written);  // nothing to add
}

TEST_F(VulkanPipelineCache, EachPipelineHasItsFile) {
  render("fresnel");
  render("stokes");
  EXPECT_EQ(files().size(), 2u);
  EXPECT_EQ(test::vulkanCalls().pipelineCacheBytes, (std::vector<std::size_t>{0, 0}));
}

TEST_F(VulkanPipelineCache, DamagedFileIsReplaced) {
  const std::vector<float> expected = render();
  const fs::path file = files().front();
  const std::vector<std::byte> good = readFile(file);
  std::vector<std::byte> flipped = good;
  flipped[good.size() / 2] ^= std::byte{1};
  const std::vector<std::vector<std::byte>> damages = {
      {}, {good.begin(), good.begin() + 5}, {good.begin(), good.end() - 1}, flipped};
  for (const std::vector<std::byte>& damaged : damages) {
    writeFile(file, damaged);
    test::watchVulkanCalls(0);
    EXPECT_EQ(render(), expected);
    EXPECT_EQ(test::vulkanCalls().pipelineCacheBytes, std::vector<std::size_t>{0});
    EXPECT_EQ(readFile(file).size(), good.size());
    EXPECT_TRUE(test::vulkanCalls().messages.empty());
  }
}

TEST_F(VulkanPipelineCache, FolderThatCannotBeWrittenIsIgnored) {
  std::ofstream(folder_ / "malus") << "a file in place of the folder";
  EXPECT_FALSE(render().empty());
  EXPECT_FALSE(fs::exists(folder_ / "malus/pipelines"));
}

TEST_F(VulkanPipelineCache, PreparedMethodsAreCompiledAtOnce) {
  const render::RenderParameters parameters = render::defaultParameters(scene_);
  std::vector<render::Preparation> images;
  for (const char* method : {"schlick", "fresnel", "sp", "stokes", "stokes-linear"})
    images.push_back({method, parameters, true});
  images.push_back({"no-such-method", parameters, false});
  images.push_back(images.front());
  Renderer renderer(scene_, {});
  renderer.prepare(images);
  const std::vector<std::thread::id> threads = test::vulkanCalls().pipelineThreads;
  ASSERT_EQ(threads.size(), 10u);
  const std::size_t different = std::set(threads.begin(), threads.end()).size();
  // By one thread on lavapipe, whose cache needs one order (programs.cpp).
  const bool isCpu = chosenDevice({}).type == "CPU";
  EXPECT_EQ(different > 1, !isCpu && std::thread::hardware_concurrency() > 1);
  for (std::size_t i = 0; i < 5; ++i) {
    const render::RenderResult image = renderer.render(images[i].method, parameters);
    EXPECT_GT(image.cost.compileMs, 0);
    EXPECT_GT(renderer.countRays(images[i].method, parameters), 0u);
    EXPECT_EQ(image.pixels, render(images[i].method.c_str()));
    EXPECT_EQ(renderer.render(images[i].method, parameters).cost.compileMs, 0);
  }
  EXPECT_EQ(test::vulkanCalls().pipelineThreads.size(), 15u);  // those of render() only
}

}  // namespace
}  // namespace malus::vulkan
