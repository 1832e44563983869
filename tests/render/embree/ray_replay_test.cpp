// Rays that are logged and traced again: they are the rays of the render, and every call of Embree finds the same hits.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/embree/ray_replay.h"
#include "render/embree/renderer.h"
#include "render/scene/methods.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::embree {
namespace {

class RayReplay : public testing::Test {
 protected:
  pack::Scene scene_ = test::mixedScene();
  render::RenderParameters parameters_ = render::defaultParameters(scene_);
  Renderer renderer_{scene_, 2};
};

std::vector<std::array<float, 6>> sortedRows(const RayArrays& rays) {
  std::vector<std::array<float, 6>> rows;
  for (std::size_t i = 0; i < rays.size(); ++i)
    rows.push_back({rays.origin[0][i], rays.origin[1][i], rays.origin[2][i], rays.direction[0][i], rays.direction[1][i],
                    rays.direction[2][i]});
  std::ranges::sort(rows);
  return rows;
}

TEST_F(RayReplay, LogsTheRaysOfTheRender) {
  for (const render::MethodInfo& method : render::methods()) {
    SCOPED_TRACE(method.name);
    const RayLog log = renderer_.logRays(method.name, parameters_);
    render::RenderParameters single = parameters_;
    single.embreePath = render::EmbreePath::scalar;
    EXPECT_EQ(countRays(log), renderer_.render(method.name, single).cost.rays);
    EXPECT_EQ(log.at({0, false}).size(), std::size_t{parameters_.width} * parameters_.height);
    EXPECT_TRUE(log.contains({1, false}));
    EXPECT_LE(log.rbegin()->first.bounce, static_cast<int>(parameters_.depth));
    EXPECT_EQ(log, Renderer(scene_, 1).logRays(method.name, parameters_)) << "depends on the threads";
  }
}

TEST_F(RayReplay, CameraRaysLeaveTheCamera) {
  const RayLog log = renderer_.logRays("fresnel", parameters_);
  const RayArrays& rays = log.at({0, false});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glm::vec3 d(rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]);
    ASSERT_NEAR(glm::length(d), 1, 1e-6);
    ASSERT_EQ(rays.origin[0][i], rays.origin[0][0]);
  }
}

TEST_F(RayReplay, SortingKeepsTheRays) {
  for (const auto& [kind, rays] : renderer_.logRays("fresnel", parameters_)) {
    const RayArrays sorted = sortRays(rays);
    EXPECT_EQ(sortedRows(sorted), sortedRows(rays));
    EXPECT_EQ(sorted, sortRays(rays));
    // By octant: the signs change at most once per octant.
    int changes = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i)
      for (const auto& direction : sorted.direction) changes += (direction[i] < 0) != (direction[i - 1] < 0);
    EXPECT_LE(changes, 11);  // 0 to 7 in binary: 7 + 3 + 1 changes of a digit
  }
}

TEST_F(RayReplay, EveryCallFindsTheSameHits) {
  const std::vector<RayCall> calls = rayCalls(renderer_.bvh());
  std::size_t native = 0;  // each has two hints and two orders, single rays one hint
  for (const unsigned width : {4u, 8u, 16u}) native += renderer_.bvh().isNative(width) ? 4 : 0;
  EXPECT_EQ(calls.size(), 2 + native);
  for (const auto& [kind, rays] : renderer_.logRays("stokes", parameters_)) {
    const RayArrays sorted = sortRays(rays);
    const ReplayResult single = replay(renderer_.bvh(), rays, kind.shadow, {}, 1);
    if (kind.bounce == 0 && !kind.shadow) {
      EXPECT_GT(single.hits, 0u);
    }
    for (const RayCall& call : calls) {
      const ReplayResult other = replay(renderer_.bvh(), call.sorted ? sorted : rays, kind.shadow, call, 2);
      EXPECT_EQ(other.hits, single.hits) << call.name() << " bounce " << kind.bounce;
      EXPECT_EQ(other.checksum, single.checksum) << call.name() << " bounce " << kind.bounce;
    }
  }
}

}  // namespace
}  // namespace malus::embree
