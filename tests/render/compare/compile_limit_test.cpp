// The part of a comparison's time in which a Vulkan device that is a CPU may compile methods.
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "render/compare/comparison.h"
#include "render/compare/time_limit.h"
#include "render/compare/warm_up.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::render {
namespace {

namespace fs = std::filesystem;

TEST(CompileLimit, IsAQuarterOfTheTimeAndAtMostFiveMinutes) {
  EXPECT_EQ(compileMinutes(std::nullopt), 5);
  EXPECT_EQ(compileMinutes(10), 2.5);
  EXPECT_EQ(compileMinutes(4), 1);
  EXPECT_EQ(compileMinutes(60), 5);
  EXPECT_EQ(compileMinutes(0), 0);  // no limit
}

// Rows by renderer after the first pass of a small scene with this much time for compiling.
std::map<Backend, std::size_t> countRows(double minutes) {
  const fs::path folder = fs::temp_directory_path() / ("malus-compile-limit-" + std::to_string(::getpid()));
  fs::create_directories(folder / "images");
  ComparisonSettings settings;
  settings.methods = {"schlick", "fresnel"};
  settings.embreePath = EmbreePath::scalar;  // no rows of second paths
  settings.compileMinutes = minutes;
  Comparison comparison;
  comparison.packs["test"].scene = test::goldScene();
  std::size_t views = 0;
  warmUp(
      comparison, settings, TimeLimit(0), folder, [](std::string_view) {}, [&](const auto&) { ++views; });
  EXPECT_EQ(views, 1U);
  std::map<Backend, std::size_t> count;
  for (const ComparisonRow& row : comparison.rows) {
    EXPECT_TRUE(row.ok()) << row.status;
    ++count[row.backend];
  }
  fs::remove_all(folder);
  return count;
}

TEST(CompileLimit, LeavesOutLaterMethodsOfVulkanOnACpuAndNoneOfEmbree) {
  const std::map<Backend, std::size_t> all = countRows(0), first = countRows(1e-9);
  EXPECT_GE(all.at(Backend::vulkan), 2U);
  EXPECT_EQ(first.at(Backend::vulkan), 1U);  // the first one is always rendered
  EXPECT_EQ(first.at(Backend::embree), all.at(Backend::embree));
}

}  // namespace
}  // namespace malus::render
