#include "meshprep/clean/intersections.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <span>
#include <utility>

#ifdef __clang_analyzer__  // it reports a false leak in CGAL's exact numbers
#define CGAL_DO_NOT_USE_MPZF
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/base/parallel_blocks.h"
#include "meshprep/base/raw_array.h"
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
constexpr std::uint64_t kMinCost = 1u << 24u;
constexpr std::size_t kMinHubTriangles = 512;
constexpr double kArcMargin = 1e-9;  // for rounding errors of directions

// Two triangles, the shared corners first.
struct TrianglePair {
  TriangleCorners a{}, b{};
  std::size_t shared = 0;
};

// Corners of a triangle with the ids of their positions, in one place of memory.
struct Corners {
  TriangleCorners points;
  std::array<std::uint32_t, 3> ids;
  bool flat;  // without area
};

TrianglePair makePair(const Corners& first, const Corners& second) {
  std::array<std::size_t, 3> a = {0, 1, 2}, b = {0, 1, 2};
  std::size_t shared = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = shared; l < 3; ++l) {
      if (first.ids[a[k]] != second.ids[b[l]]) continue;
      std::swap(a[k], a[shared]);
      std::swap(b[l], b[shared]);
      ++shared;
      break;
    }
  return {{first.points[a[0]], first.points[a[1]], first.points[a[2]]},
          {second.points[b[0]], second.points[b[1]], second.points[b[2]]},
          shared};
}

Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }
Kernel::Triangle_3 triangle(const TriangleCorners& t) { return {point(t[0]), point(t[1]), point(t[2])}; }

// Floating-point test: true if they certainly do not touch outside of shared corners, also if corners move by at most
// this distance.
bool areCertainlySeparate(const TrianglePair& pair, double distance = 0) {
  if (pair.shared == 0) return areSeparate(pair.a, pair.b, distance);
  return pair.shared == 1 ? areSeparateBesideCorner(pair.a, pair.b, distance)
                          : areSeparateBesideEdge(pair.a, pair.b, distance);
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

// Returns true if the triangle has no area.
bool isFlat(const TriangleCorners& a) {
  return !certainlyHasArea(a) && CGAL::collinear(point(a[0]), point(a[1]), point(a[2]));
}

// Returns the corners of each triangle, and marks triangles without area.
RawArray<Corners> collectCorners(const Mesh& mesh) {
  RawArray<Corners> corners(mesh.triangles.size());
  const std::vector<std::uint32_t> ids = positionIds(mesh);
  forNumbers(mesh.triangles.size(), [&](std::size_t i) {
    Corners& c = corners[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[i][static_cast<int>(k)];
      c.points[k] = mesh.positions[v];
      c.ids[k] = ids[v];
    }
    c.flat = isFlat(c.points);
  });
  return corners;
}

enum class Relation { separate, crossing, coincident };

// Exact relation of two triangles of which floating point does not decide that they are separate.
Relation relateExactly(const TrianglePair& pair) {
  if (pair.shared == 3) return Relation::coincident;
  return touchExactly(pair) ? Relation::crossing : Relation::separate;
}

Box boundingBox(const Corners& c) {
  return {glm::min(c.points[0], glm::min(c.points[1], c.points[2])),
          glm::max(c.points[0], glm::max(c.points[1], c.points[2]))};
}

Box makeBox(const glm::dvec3& a, const glm::dvec3& b, double margin) {
  return {glm::min(a, b) - margin, glm::max(a, b) + margin};
}

// Search for touching triangles. The boxes of all triangles around one vertex overlap. Around a vertex of many
// triangles (a hub) the pairs are found by direction instead: two triangles with a common corner touch elsewhere only
// if the arcs meet in which they cut a small sphere around it.
class Search {
 public:
  Search(const Mesh& mesh, std::size_t first) : corners_(collectCorners(mesh)), first_(first), boxes_(corners_.size()) {
    forNumbers(corners_.size(), [&](std::size_t i) { boxes_[i] = boundingBox(corners_[i]); });
    if (first == 0) findHubs(mesh.positions.size());
  }

  Intersections run() {
    std::vector<std::uint32_t> others;  // triangles that are not assigned to a hub, or to an earlier one
    for (std::uint32_t i = 0; i < corners_.size(); ++i)
      if (hubOf_.empty() || hubOf_[i] == kNoSource) others.push_back(i);
    searchBetween(std::span(others).subspan(first_), others, kNoSource);
    for (const std::uint32_t hub : hubs_) {
      std::vector<std::uint32_t> assigned, around;
      for (std::uint32_t i = 0; i < corners_.size(); ++i) {
        if (hubOf_[i] == hub) assigned.push_back(i);
        if (hasCorner(i, hub)) around.push_back(i);
      }
      searchBetween(others, assigned, hub);
      searchAround(hub, around);
      others.insert(others.end(), assigned.begin(), assigned.end());
    }
    result_.exactTests = exactTests_;
    if (!result_.complete) return {{}, {}, result_.exactTests, false};

    // Sort, because the order of the threads varies; a pair with two common hubs is found twice.
    for (auto* pairs : {&result_.crossing, &result_.coincident}) {
      std::sort(pairs->begin(), pairs->end());
      pairs->erase(std::unique(pairs->begin(), pairs->end()), pairs->end());
    }
    return std::move(result_);
  }

 private:
  bool hasCorner(std::uint32_t triangle, std::uint32_t id) const {
    const auto& ids = corners_[triangle].ids;
    return ids[0] == id || ids[1] == id || ids[2] == id;
  }

  // Assigns each triangle to its first corner that is a hub. There are at most about sqrt(n) hubs of n triangles.
  void findHubs(std::size_t vertexCount) {
    std::vector<std::uint32_t> uses(vertexCount, 0);
    for (const Corners& c : corners_)
      for (const std::uint32_t id : c.ids) ++uses[id];
    const auto limit =
        std::max(kMinHubTriangles, static_cast<std::size_t>(4 * std::sqrt(static_cast<double>(corners_.size()))));
    for (std::uint32_t id = 0; id < uses.size(); ++id)
      if (uses[id] > limit) hubs_.push_back(id);
    if (hubs_.empty()) return;
    for (const Corners& c : corners_) {
      const auto* const hub =
          std::find_if(c.ids.begin(), c.ids.end(), [&](std::uint32_t id) { return uses[id] > limit; });
      hubOf_.push_back(hub == c.ids.end() ? kNoSource : *hub);
    }
  }

  // Tests a pair, exactly if floating point does not decide. Returns the cost.
  std::uint32_t test(std::uint32_t i, std::uint32_t j) {
    if (corners_[i].flat || corners_[j].flat) return 0;
    const TrianglePair pair = makePair(corners_[i], corners_[j]);
    if (pair.shared < 3 && areCertainlySeparate(pair)) return kCostOfTest;
    exactTests_.fetch_add(1, std::memory_order_relaxed);
    const Relation relation = relateExactly(pair);
    if (relation == Relation::separate) return kCostOfExactTest;
    const std::lock_guard guard(lock_);
    (relation == Relation::crossing ? result_.crossing : result_.coincident)
        .emplace_back(std::min(i, j), std::max(i, j));
    return kCostOfExactTest;
  }

  std::uint64_t mostCost(std::size_t boxes) const {
    return kCostPerTriangle * boxes + kMinCost / (1 + 2 * hubs_.size());
  }

  // Tests the triangles of two lists whose boxes overlap, except pairs with the hub as a common corner. Without a hub,
  // `a` is the end of `b`, and each pair is tested once.
  void searchBetween(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, std::uint32_t hub) {
    if (a.empty() || b.empty() || !result_.complete) return;
    const auto take = [&](std::span<const std::uint32_t> list) {
      std::vector<Box> boxes;
      boxes.reserve(list.size());
      for (const std::uint32_t i : list) boxes.push_back(boxes_[i]);
      return boxes;
    };
    std::vector<Box> boxesOfA, boxesOfB;
    if (b.size() < boxes_.size()) boxesOfB = take(b);
    const std::span<const Box> inB = boxesOfB.empty() ? std::span<const Box>(boxes_) : boxesOfB;
    if (hub == kNoSource && a.size() == b.size()) {
      const auto testPair = [&](std::uint32_t k, std::uint32_t l) { return test(b[k], b[l]); };
      result_.complete = forOverlappingPairs(inB, mostCost(a.size() + b.size()), testPair);
      return;
    }
    if (hub != kNoSource) boxesOfA = take(a);
    const std::span<const Box> inA = hub == kNoSource ? inB.last(a.size()) : boxesOfA;
    result_.complete = forOverlappingBoxes(inA, inB, mostCost(a.size() + b.size()),
                                           [&](std::uint32_t k, std::uint32_t l) -> std::uint32_t {
                                             const std::uint32_t i = a[k], j = b[l];
                                             if (hub == kNoSource ? j >= i : hasCorner(i, hub)) return 0;
                                             return test(i, j);
                                           });
  }

  // Tests the triangles around a hub whose arcs on a sphere around it are close to each other.
  void searchAround(std::uint32_t hub, std::span<const std::uint32_t> triangles) {
    if (!result_.complete) return;
    std::vector<Box> arcs;
    arcs.reserve(triangles.size());
    for (const std::uint32_t i : triangles) {
      const Corners& c = corners_[i];
      const auto at = static_cast<std::size_t>(std::find(c.ids.begin(), c.ids.end(), hub) - c.ids.begin());
      const glm::dvec3 &centre = c.points[at], &p = c.points[(at + 1) % 3], &q = c.points[(at + 2) % 3];
      if (p == centre || q == centre) {  // without area
        arcs.push_back(makeBox(glm::dvec3(9), glm::dvec3(9), 0));
        continue;
      }
      // The arc is at most its sagitta away from the chord.
      const glm::dvec3 from = glm::normalize(p - centre), to = glm::normalize(q - centre);
      const double chord = glm::distance(from, to);
      arcs.push_back(makeBox(from, to, 1 - std::sqrt(std::max(0.0, 1 - chord * chord / 4)) + kArcMargin));
    }
    const auto testPair = [&](std::uint32_t k, std::uint32_t l) { return test(triangles[k], triangles[l]); };
    result_.complete = forOverlappingPairs(arcs, mostCost(arcs.size()), testPair);
  }

  RawArray<Corners> corners_;
  std::size_t first_;
  RawArray<Box> boxes_;
  std::vector<std::uint32_t> hubs_, hubOf_;  // ids of positions; hubOf_ is one per triangle, or empty without hubs
  Intersections result_;
  std::mutex lock_;
  std::atomic<std::uint64_t> exactTests_{0};
};

}  // namespace

Intersections findIntersections(const Mesh& mesh, std::size_t first) { return Search(mesh, first).run(); }

Intersections testPairs(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles,
                        std::span<const Intersections::Pair> pairs) {
  Intersections result;
  for (const auto& [first, second] : pairs) {
    // Number the corners by their positions. A pair that is certainly separate needs no test for area.
    std::array<Corners, 2> sides{};
    std::array<glm::dvec3, 6> points{};
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = positions[triangles[i < 3 ? first : second][static_cast<int>(i % 3)]];
      sides[i / 3].points[i % 3] = points[i];
      sides[i / 3].ids[i % 3] =
          static_cast<std::uint32_t>(std::find(points.begin(), points.end(), points[i]) - points.begin());
    }
    const TrianglePair pair = makePair(sides[0], sides[1]);
    if (pair.shared < 3 && areCertainlySeparate(pair)) continue;
    if (isFlat(sides[0].points) || isFlat(sides[1].points)) continue;
    ++result.exactTests;
    const Relation relation = relateExactly(pair);
    if (relation == Relation::separate) continue;
    (relation == Relation::crossing ? result.crossing : result.coincident).emplace_back(first, second);
  }
  for (auto* list : {&result.crossing, &result.coincident}) std::sort(list->begin(), list->end());
  return result;
}

std::optional<std::vector<Intersections::Pair>> findClosePairs(const Mesh& mesh, double distance) {
  const RawArray<Corners> corners = collectCorners(mesh);
  std::vector<std::uint32_t> uses(mesh.positions.size(), 0);
  std::vector<Box> boxes;
  boxes.reserve(corners.size());
  for (const Corners& c : corners) {
    for (const std::uint32_t id : c.ids)
      if (++uses[id] > kMinHubTriangles) return std::nullopt;
    const Box box = boundingBox(c);
    boxes.push_back({box.low - distance, box.high + distance});
  }
  std::vector<Intersections::Pair> pairs;
  std::mutex lock;
  const auto test = [&](std::uint32_t i, std::uint32_t j) {
    const TrianglePair pair = makePair(corners[i], corners[j]);
    if (!corners[i].flat && !corners[j].flat && pair.shared < 3 && areCertainlySeparate(pair, distance))
      return kCostOfTest;
    const std::lock_guard guard(lock);
    pairs.emplace_back(j, i);
    return kCostOfExactTest;
  };
  if (!forOverlappingPairs(boxes, kCostPerTriangle * boxes.size() + kMinCost, test)) return std::nullopt;
  std::sort(pairs.begin(), pairs.end());
  return pairs;
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
