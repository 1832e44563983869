// Recorded rays, traced again by the Vulkan device, against Embree.
#include "render/vulkan/ray_replay.h"

#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/embree/ray_replay.h"
#include "render/embree/renderer.h"
#include "tests/render/vulkan/limits.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::vulkan {
namespace {

using render::VulkanPath;

std::vector<RecordedRay> toRecorded(const embree::RayArrays& rays) {
  const auto& [o, d] = rays;
  std::vector<RecordedRay> list;
  for (std::size_t i = 0; i < rays.size(); ++i)
    list.push_back({{o[0][i], o[1][i], o[2][i]}, {d[0][i], d[1][i], d[2][i]}});
  return list;
}

class RayReplays : public testing::Test {
 protected:
  pack::Scene scene_ = test::mixedScene();
};

// Rays that meet an edge may pass beside both triangles by the arithmetic of one of them: 1 of 1000.
TEST_F(RayReplays, FindTheHitsOfEmbree) {
  embree::Renderer renderer(scene_, 2);
  RayReplay replay(scene_, {});
  ASSERT_EQ(replay.paths(), (std::vector{VulkanPath::query, VulkanPath::pipeline}));
  std::uint64_t shadows = 0;
  for (const auto& [kind, rays] : renderer.logRays("fresnel", render::defaultParameters(scene_))) {
    SCOPED_TRACE(testing::Message() << "bounce " << kind.bounce << (kind.shadow ? ", shadow" : ""));
    const auto expected = embree::replay(renderer.bvh(), rays, kind.shadow, {}, 1).hits;
    const auto tolerance = static_cast<double>(rays.size()) * 1e-3;
    for (const VulkanPath path : replay.paths()) {
      const ReplayTime found = replay.replay(path, kind.shadow, toRecorded(rays));
      EXPECT_NEAR(static_cast<double>(found.hits), static_cast<double>(expected), tolerance) << vulkanPathName(path);
      EXPECT_GT(found.ms, 0);
    }
    if (kind.shadow) shadows += expected;
  }
  EXPECT_GT(shadows, 0u);  // some of the shadow rays are blocked
}

// Known hits at the limits of a launch: every second ray points away.
TEST_F(RayReplays, CountAcrossLaunches) {
  const pack::Scene gold = test::goldScene();
  RayReplay replay(gold, {});
  for (const std::size_t count : {std::size_t{1}, std::size_t{1023}, std::size_t{1025}, kReplayRays + 3}) {
    std::vector<RecordedRay> rays(count, {{0, 0, 4}, {0, 0, -1}});
    for (std::size_t i = 1; i < count; i += 2) rays[i].d.z = 1;
    for (const VulkanPath path : replay.paths()) EXPECT_EQ(replay.replay(path, false, rays).hits, (count + 1) / 2);
  }
}

// The square is at a distance of 4: a shadow ray ends at its direction times 1.
TEST_F(RayReplays, ShadowRaysEnd) {
  const pack::Scene gold = test::goldScene();
  RayReplay replay(gold, {});
  const std::vector<RecordedRay> rays = {{{0, 0, 4}, {0, 0, -3.9f}}, {{0, 0, 4}, {0, 0, -4.1f}}};
  for (const VulkanPath path : replay.paths()) {
    EXPECT_EQ(replay.replay(path, true, rays).hits, 1u);
    EXPECT_EQ(replay.replay(path, false, rays).hits, 2u);
    EXPECT_EQ(replay.replay(path, false, {}).hits, 0u);
  }
}

TEST_F(RayReplays, WorkWithoutRayQueries) {
  const test::Limits limits("rayQuery=0");
  RayReplay replay(scene_, {});
  ASSERT_EQ(replay.paths(), std::vector{VulkanPath::pipeline});
  const std::vector<RecordedRay> ray = {{{0, 5, 0}, {0, -1, 0}}};
  EXPECT_EQ(replay.replay(VulkanPath::pipeline, false, ray).hits, 1u);
}

}  // namespace
}  // namespace malus::vulkan
