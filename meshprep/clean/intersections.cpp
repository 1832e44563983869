#include "meshprep/clean/intersections.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <span>
#include <utility>

#ifdef __clang_analyzer__  // it reports a false leak in CGAL's exact numbers
#define CGAL_DO_NOT_USE_MPZF
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <glm/common.hpp>

#include "meshprep/clean/box_pairs.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/clean/select.h"
#include "meshprep/clean/separation.h"

namespace malus::prep {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Costs, in units of a few nanoseconds: 96 per pair in floating point, a microsecond for exact predicates.
constexpr std::uint32_t kCostOfTest = 1, kCostOfExactTest = 16;
constexpr std::uint64_t kCostPerTriangle = 32;  // average; a fine mesh has about 7
constexpr std::uint64_t kMinCost = 1u << 24u;   // a fan of 5000 triangles around a vertex needs as much

// Two triangles, the shared corners first.
struct TrianglePair {
  TriangleCorners a{}, b{};
  std::size_t shared = 0;
};

// Corners of a triangle with the ids of their positions, in one place of memory.
struct Corners {
  TriangleCorners points{};
  std::array<std::uint32_t, 3> ids{};
  bool flat = false;  // without area
};

TrianglePair makePair(const Corners& first, const Corners& second) {
  TrianglePair pair{first.points, second.points, 0};
  std::array<std::uint32_t, 3> a = first.ids, b = second.ids;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = pair.shared; l < 3; ++l) {
      if (a[k] != b[l]) continue;
      const std::size_t to = pair.shared++;
      std::swap(a[k], a[to]);
      std::swap(pair.a[k], pair.a[to]);
      std::swap(b[l], b[to]);
      std::swap(pair.b[l], pair.b[to]);
      break;
    }
  return pair;
}

Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }
Kernel::Triangle_3 triangle(const TriangleCorners& t) { return {point(t[0]), point(t[1]), point(t[2])}; }

// Floating-point test: true if they certainly do not touch outside of shared corners.
bool areCertainlySeparate(const TrianglePair& pair) {
  if (pair.shared == 0) return areSeparate(pair.a, pair.b);
  return pair.shared == 1 ? areSeparateBesideCorner(pair.a, pair.b) : areSeparateBesideEdge(pair.a, pair.b);
}

// Exact test: true if they touch outside of shared corners.
bool touchExactly(const TrianglePair& pair) {
  const auto& [a, b, shared] = pair;
  if (shared == 2) {
    // Triangles with a common edge meet elsewhere only if one is folded onto the other.
    const Kernel::Point_3 p = point(a[0]), q = point(a[1]), r = point(a[2]), s = point(b[2]);
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }
  if (shared == 1)
    return CGAL::do_intersect(Kernel::Segment_3(point(a[1]), point(a[2])), triangle(b)) ||
           CGAL::do_intersect(Kernel::Segment_3(point(b[1]), point(b[2])), triangle(a));
  return CGAL::do_intersect(triangle(a), triangle(b));
}

}  // namespace

Intersections findIntersections(const Mesh& mesh, std::size_t first) {
  // Compute bounding boxes.
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 &p = mesh.positions[t.x], &q = mesh.positions[t.y], &r = mesh.positions[t.z];
    boxes.push_back({glm::min(p, glm::min(q, r)), glm::max(p, glm::max(q, r))});
  }

  // Collect the corners, and mark triangles without area.
  std::vector<Corners> corners(mesh.triangles.size());
  const std::vector<std::uint32_t> ids = positionIds(mesh);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Corners& c = corners[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[i][static_cast<int>(k)];
      c.points[k] = mesh.positions[v];
      c.ids[k] = ids[v];
    }
    c.flat = !certainlyHasArea(c.points) && CGAL::collinear(point(c.points[0]), point(c.points[1]), point(c.points[2]));
  }

  // Test pairs with overlapping boxes, exactly if floating point does not decide.
  Intersections result;
  std::mutex lock;
  std::atomic<std::uint64_t> exactTests{0};
  const auto test = [&](std::uint32_t fromFirst, std::uint32_t j) -> std::uint32_t {
    const auto i = static_cast<std::uint32_t>(fromFirst + first);
    if (j >= i || corners[i].flat || corners[j].flat) return 0;
    const TrianglePair pair = makePair(corners[j], corners[i]);
    if (pair.shared < 3 && areCertainlySeparate(pair)) return kCostOfTest;
    exactTests.fetch_add(1, std::memory_order_relaxed);
    if (pair.shared < 3 && !touchExactly(pair)) return kCostOfExactTest;
    const std::lock_guard guard(lock);
    (pair.shared < 3 ? result.crossing : result.coincident).emplace_back(j, i);
    return kCostOfExactTest;
  };
  result.complete =
      forOverlappingBoxes(std::span(boxes).subspan(first), boxes, kCostPerTriangle * boxes.size() + kMinCost, test);
  result.exactTests = exactTests;
  if (!result.complete) return {{}, {}, result.exactTests, false};

  // Sort, because the order of the threads varies.
  std::sort(result.crossing.begin(), result.crossing.end());
  std::sort(result.coincident.begin(), result.coincident.end());
  return result;
}

Findings describePairs(const Mesh& mesh, const std::vector<Intersections::Pair>& pairs) {
  Findings findings;
  for (const auto& [a, b] : pairs)
    findings.add([&, first = a, second = b] {
      return findingAt(mesh, (centroid(mesh, first) + centroid(mesh, second)) * 0.5, {first, second});
    });
  return findings;
}

}  // namespace malus::prep
