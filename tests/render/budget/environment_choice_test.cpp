// --max-error chooses between sampled light of the environment and the irradiance by spherical harmonics.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "render/budget/budget.h"
#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

class EnvironmentChoice : public testing::Test {
 protected:
  void SetUp() override { ::setenv("XDG_CACHE_HOME", cache_.c_str(), 1); }
  void TearDown() override {
    ::unsetenv("XDG_CACHE_HOME");
    std::filesystem::remove_all(cache_);
  }
  const std::filesystem::path cache_ =
      std::filesystem::temp_directory_path() / fmt::format("malus-environment-choice-{}", ::getpid());
};

// A matt floor with a small plate over it, in the light of a constant sky.
pack::Pack floorUnderSky() {
  pack::Pack pack;
  pack.hash = 1;
  pack.scene = test::emptyScene(1);
  pack::Scene& scene = pack.scene;
  scene.width = scene.height = 96;
  scene.camera.verticalFovDegrees = 50;
  scene.environment.radiance = glm::dvec3(0.25);
  scene.environment.illuminates = true;
  scene.environment.ambientIrradiance = 1;
  scene.environment.irradiance[0] = std::numbers::pi * scene.environment.radiance;  // the same in every direction
  test::addMaterial(scene, test::dielectric(pack::MaterialKind::lambert, 1, 0.5));
  test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 4);
  test::addSquare(scene, 0, {0, 0.2, 0}, {0, 1, 0}, 0.3);
  test::look(scene, {0, 3, 4}, {0, 0, 0});
  return pack;
}

bool leavesOut(const Budget& budget, const char* effect) {
  return std::find(budget.chosen.off.begin(), budget.chosen.off.end(), effect) != budget.chosen.off.end();
}

TEST_F(EnvironmentChoice, TakesTheHarmonicsWhereTheErrorAllowsThem) {
  const pack::Pack pack = floorUnderSky();
  RendererPool pool(pack.scene, Backend::embree, {"", 1});
  BudgetSearch search(pack, defaultParameters(pack.scene), pool, true, 1, [](std::string_view) {});

  const Budget rough = search.withinError(0.3);
  EXPECT_TRUE(leavesOut(rough, "environment-light"));
  ASSERT_NE(rough.image.scene, nullptr);
  EXPECT_FALSE(rough.image.scene->environment.illuminates);
  EXPECT_LE(rough.checked.relRms, 0.3);
  // The harmonics light the floor: without any light the error would be 1 on all but the sky.
  const RenderResult image = pool[rough.image.scene].render(rough.image.method, rough.image.parameters);
  const std::size_t centre = (std::size_t{image.height} - 4) * image.width + image.width / 2;
  EXPECT_NEAR(image.pixels[centre * image.channels], 0.5 * 0.25, 1e-3) << "albedo times the radiance of the sky";

  EXPECT_FALSE(leavesOut(search.withinError(1e-4), "environment-light")) << "the plate's shadow";
  EXPECT_TRUE(search.withinError(0).parts.empty());
}

}  // namespace
}  // namespace malus::render
