#include "meshprep/clean/intersections.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/clean/box_pairs.h"
#include "meshprep/clean/separation.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using Pairs = std::vector<Intersections::Pair>;

Mesh two(const std::vector<glm::dvec3>& positions) {
  Mesh mesh;
  mesh.positions = positions;
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

TEST(Intersections, FindsNoneInValidSolids) {
  for (const Mesh& mesh : {test::cube(), test::sphere(15, 32), test::joined(test::cube(), test::cube(1, {3, 0, 0}))}) {
    const Intersections found = findIntersections(mesh);
    EXPECT_TRUE(found.crossing.empty());
    EXPECT_TRUE(found.coincident.empty());
    EXPECT_TRUE(found.complete);
  }
}

TEST(Intersections, FindsCrossingAndTouchingTriangles) {
  const std::vector<glm::dvec3> base = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto with = [&](std::vector<glm::dvec3> other) {
    std::vector<glm::dvec3> all = base;
    all.insert(all.end(), other.begin(), other.end());
    return findIntersections(two(all)).crossing.size();
  };
  EXPECT_EQ(with({{1, 1, -1}, {1, 1, 1}, {2, 2, 1}}), 1u);     // through it
  EXPECT_EQ(with({{1, 1, 0}, {1, 2, 1}, {2, 1, 1}}), 1u);      // a tip on it
  EXPECT_EQ(with({{1, 1, 1e-12}, {1, 2, 1}, {2, 1, 1}}), 0u);  // a tip above it
  EXPECT_EQ(with({{1, 1, 0}, {9, 1, 0}, {1, 9, 0}}), 1u);      // in its plane, over it
  EXPECT_EQ(with({{5, 5, 0}, {9, 5, 0}, {5, 9, 0}}), 0u);      // in its plane, beside it
  EXPECT_EQ(with({{2, 0, 0}, {2, -1, 0}, {3, -1, 0}}), 1u);    // a corner on its edge
}

TEST(Intersections, AcceptsSharedCornersOnly) {
  const auto count = [](const std::vector<glm::dvec3>& other) {
    std::vector<glm::dvec3> all = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    all.insert(all.end(), other.begin(), other.end());
    const Intersections found = findIntersections(two(all));
    return std::pair(found.crossing.size(), found.coincident.size());
  };
  using Counts = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(count({{0, 0, 0}, {4, 0, 0}, {0, -4, 0}}), Counts(0, 0));   // an edge, flat on
  EXPECT_EQ(count({{0, 0, 0}, {4, 0, 0}, {1, 1, 3}}), Counts(0, 0));    // an edge, at an angle
  EXPECT_EQ(count({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}), Counts(1, 0));    // an edge, folded over
  EXPECT_EQ(count({{0, 0, 0}, {-1, 0, 1}, {0, -1, 1}}), Counts(0, 0));  // a corner
  EXPECT_EQ(count({{0, 0, 0}, {1, 2, 1}, {2, 1, -1}}), Counts(1, 0));   // a corner, and through
  EXPECT_EQ(count({{0, 0, 0}, {1, 1, 0}, {-1, 3, 0}}), Counts(1, 0));   // a corner, and over in the plane
  EXPECT_EQ(count({{4, 0, 0}, {0, 0, 0}, {0, 4, 0}}), Counts(0, 1));    // the same three
}

TEST(Separation, IsProvenForMostPairsAndNeverForTouchingOnes) {
  // Random triangles on a small grid touch often; those in general position are separated by floating point.
  std::mt19937 random(1);
  const auto draw = [&] {
    return TriangleCorners{glm::dvec3(random() % 4, random() % 4, random() % 3),
                           glm::dvec3(random() % 4, random() % 4, random() % 3),
                           glm::dvec3(random() % 4, random() % 4, random() % 3)};
  };
  std::array<int, 3> proven{}, separate{};
  for (int i = 0; i < 60000; ++i) {
    const TriangleCorners a = draw();
    TriangleCorners b = draw();
    const auto shared = static_cast<std::size_t>(i % 3);
    for (std::size_t k = 0; k < shared; ++k) b[k] = a[k];
    if (!certainlyHasArea(a) || !certainlyHasArea(b)) continue;
    const Intersections found = findIntersections(two({a[0], a[1], a[2], b[0], b[1], b[2]}));
    std::size_t common = 0;
    for (const glm::dvec3& p : a)
      for (const glm::dvec3& q : b) common += p == q ? 1u : 0u;
    if (common != shared) continue;
    const bool isProven = shared == 0   ? areSeparate(a, b)
                          : shared == 1 ? areSeparateBesideCorner(a, b)
                                        : areSeparateBesideEdge(a, b);
    if (isProven) {
      EXPECT_TRUE(found.crossing.empty()) << i;
      ++proven[shared];
    }
    separate[shared] += found.crossing.empty() ? 1 : 0;
  }
  for (std::size_t shared = 0; shared < 3; ++shared) {
    EXPECT_GT(separate[shared], 3000);
    EXPECT_GT(proven[shared], 0.95 * separate[shared]) << shared;
  }
}

TEST(Separation, IsExactFarFromTheOrigin) {
  // The gap is one unit in the last place of the coordinates.
  const double x = 1e6, gap = 1.1641532182693481e-10;
  const TriangleCorners a = {glm::dvec3(x, 0, 0), glm::dvec3(x, 1, 0), glm::dvec3(x, 0, 1)};
  const TriangleCorners b = {glm::dvec3(x + gap, 0, 0), glm::dvec3(x + 1, 1, 0), glm::dvec3(x + 1, 0, 1)};
  EXPECT_TRUE(areSeparate(a, b));
  TriangleCorners touching = b;
  touching[0].x = x;
  touching[0].y = touching[0].z = 0.25;
  EXPECT_FALSE(areSeparate(a, touching));
}

// Fan of n triangles around a point, in a tilted plane.
Mesh fan(std::uint32_t n) {
  Mesh mesh;
  mesh.positions.emplace_back(0.1, 0.2, 0.3);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 6.2831853071795862 * i / n;
    mesh.positions.push_back(mesh.positions[0] + std::cos(angle) * glm::dvec3(0.6, 0.64, 0.48) +
                             std::sin(angle) * glm::dvec3(0.8, -0.48, -0.36));
    mesh.triangles.emplace_back(0, i + 1, (i + 1) % n + 1);
  }
  return mesh;
}

TEST(Intersections, NeedsFewExactTests) {
  // Neighbours in one plane, within rounding, need them; their number must not grow with the square of the triangles.
  for (const std::uint32_t n : {500u, 1000u, 2000u, 20000u}) {
    const Intersections found = findIntersections(fan(n));
    EXPECT_TRUE(found.complete) << n;
    EXPECT_TRUE(found.crossing.empty()) << n;
    EXPECT_LE(found.exactTests, 2 * n) << n;
  }
  const Mesh sphere = test::sphere(60, 90);
  EXPECT_LE(findIntersections(sphere).exactTests, sphere.triangles.size() / 10);
}

TEST(Intersections, FindsPairsAroundVerticesOfManyTriangles) {
  // Triangles through a fan: with its centre as a corner, without a common corner, with two fans, and a copy.
  constexpr std::uint32_t kCount = 900;
  Mesh mesh = fan(kCount);
  const glm::dvec3 centre = mesh.positions[0], up(0, -0.6, 0.8);
  const auto add = [&](const glm::dvec3& p) {
    mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  const auto within = [&](std::uint32_t i, double share) {
    const glm::uvec3& t = mesh.triangles[i];
    return centre + share * ((mesh.positions[t.y] + mesh.positions[t.z]) * 0.5 - centre);
  };
  const std::uint32_t first = kCount;
  mesh.triangles.emplace_back(0, add(within(100, 0.5) + 0.1 * up), add(within(100, 0.5) - 0.1 * up));
  mesh.triangles.emplace_back(add(within(200, 0.5) + 0.1 * up), add(within(200, 0.5) - 0.1 * up),
                              add(within(200, 3.0)));
  mesh.triangles.push_back(mesh.triangles[300]);
  mesh.triangles.emplace_back(0, add(centre + up), add(centre + up + glm::dvec3(0.1, 0, 0)));  // beside it
  const Intersections found = findIntersections(mesh);
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.crossing, (Pairs{{100, first}, {200, first + 1}}));
  EXPECT_EQ(found.coincident, (Pairs{{300, first + 2}}));
  EXPECT_LT(found.exactTests, 3 * kCount);

  // Two fans that cross, with their triangles mixed.
  Mesh two = fan(kCount), other = fan(kCount);
  for (glm::dvec3& p : other.positions) p += (0.4 + (p - centre).x) * up;
  const Mesh both = test::joined(two, other);
  const Intersections crossed = findIntersections(both);
  EXPECT_GT(crossed.crossing.size(), 300u);
  Mesh few = both;
  few.triangles.resize(kCount + 300);  // no second hub
  std::size_t expected = 0;
  for (const auto& [a, b] : crossed.crossing) expected += b < kCount + 300 ? 1u : 0u;
  EXPECT_EQ(findIntersections(few).crossing.size(), expected);
}

TEST(Intersections, MatchesTheTestOfAllPairs) {
  const Mesh mesh = test::joined(test::sphere(6, 9), [] {
    Mesh other = test::sphere(5, 8);
    for (glm::dvec3& p : other.positions) p = p * 0.9 + glm::dvec3(0.61, 0.37, 0.23);
    return other;
  }());
  const Intersections all = findIntersections(mesh);
  Pairs alone;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::uint32_t j = i + 1; j < mesh.triangles.size(); ++j) {
      Mesh pair;
      pair.positions = mesh.positions;
      pair.triangles = {mesh.triangles[i], mesh.triangles[j]};
      if (!findIntersections(pair).crossing.empty()) alone.emplace_back(i, j);
    }
  EXPECT_GT(all.crossing.size(), 10u);
  EXPECT_EQ(all.crossing, alone);
  // Each pair has a triangle of each sphere.
  for (const auto& [a, b] : all.crossing) EXPECT_TRUE(a < 108 && b >= 108) << a << ' ' << b;
}

TEST(Intersections, IsIncompleteForTooManyPairs) {
  // Long thin triangles through one point: all boxes overlap.
  Mesh mesh;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> draw(-1, 1);
  constexpr std::uint32_t kCount = 9000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(draw(random), draw(random), draw(random)));
    mesh.positions.push_back(d);
    mesh.positions.push_back(-d);
    mesh.positions.push_back(-d + glm::dvec3(1e-3, 0, 0));
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  EXPECT_FALSE(findIntersections(mesh).complete);
}

TEST(BoxPairs, FindsOverlappingAndTouchingBoxesOnce) {
  const std::vector<Box> a = {{{0, 0, 0}, {1, 1, 1}}, {{5, 5, 5}, {6, 6, 6}}};
  const std::vector<Box> b = {{{1, 1, 1}, {2, 2, 2}}, {{1.001, 0, 0}, {2, 1, 1}}, {{-9, -9, -9}, {9, 9, 9}}};
  std::array<std::atomic<int>, 6> seen{};
  EXPECT_TRUE(forOverlappingBoxes(a, b, 100, [&](std::uint32_t i, std::uint32_t j) { return ++seen[3 * i + j] > 0; }));
  const std::array<int, 6> expected = {1, 0, 1, 0, 0, 1};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(seen[i], expected[i]) << i;
  EXPECT_FALSE(forOverlappingBoxes(a, b, 2, [](std::uint32_t, std::uint32_t) { return true; }));
}

// Boxes of all shapes, many of them equal, and some far from the others.
std::vector<Box> randomBoxes(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(0, 1);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 low(draw(random), draw(random), i % 7 == 0 ? 1e9 : 0.25 * std::floor(4 * draw(random)));
    boxes.push_back({low, low + 0.2 * glm::dvec3(draw(random), i % 5 == 0 ? 3 : 0.1, i % 3 == 0 ? 0 : 0.25)});
    if (i % 4 == 0) boxes.back() = boxes[i / 2];
  }
  return boxes;
}

TEST(BoxPairs, MatchTheTestOfAllPairs) {
  for (const std::size_t count : {0u, 1u, 2u, 8u, 9u, 17u, 100u, 1500u}) {
    const std::vector<Box> a = randomBoxes(count, 1), b = randomBoxes(count / 2 + 1, 2);
    std::mutex lock;
    std::vector<std::array<std::uint32_t, 2>> between, within, expected;
    const auto add = [&](auto& pairs) {
      return [&lock, &pairs](std::uint32_t i, std::uint32_t j) {
        const std::lock_guard guard(lock);
        pairs.push_back({i, j});
        return 1u;
      };
    };
    EXPECT_TRUE(forOverlappingBoxes(a, b, count * count, add(between)));
    EXPECT_TRUE(forOverlappingPairs(a, count * count, add(within)));
    for (std::uint32_t i = 0; i < a.size(); ++i)
      for (std::uint32_t j = 0; j < b.size(); ++j)
        if (overlap(a[i], b[j])) expected.push_back({i, j});
    std::sort(between.begin(), between.end());
    EXPECT_EQ(between, expected) << count;
    expected.clear();
    for (std::uint32_t i = 0; i < a.size(); ++i)
      for (std::uint32_t j = 0; j < i; ++j)
        if (overlap(a[i], a[j])) expected.push_back({i, j});
    std::sort(within.begin(), within.end());
    EXPECT_EQ(within, expected) << count;
    if (expected.empty()) continue;
    EXPECT_FALSE(forOverlappingPairs(a, expected.size() - 1, [](std::uint32_t, std::uint32_t) { return 1u; }));
  }
}

}  // namespace
}  // namespace malus::prep
