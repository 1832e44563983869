#include "meshprep/clean/intersections.h"

#include <algorithm>
#include <array>
#include <mutex>

#ifdef __clang_analyzer__  // it reports a false leak in CGAL's exact numbers
#define CGAL_DO_NOT_USE_MPZF
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <glm/common.hpp>

#include "meshprep/clean/box_pairs.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr std::uint64_t kTestsPerTriangle = 32;  // average; a fine mesh has about 7
constexpr std::uint64_t kMinTests = 1u << 23u;   // a fan of 4000 triangles around a vertex needs as many

// Corners of a triangle with their position ids.
struct Corners {
  std::array<Kernel::Point_3, 3> point;
  std::array<std::uint32_t, 3> positionId{};
  Kernel::Triangle_3 triangle() const { return {point[0], point[1], point[2]}; }
  Kernel::Segment_3 acrossFrom(std::size_t corner) const { return {point[(corner + 1) % 3], point[(corner + 2) % 3]}; }
};

Corners makeCorners(const Mesh& mesh, const std::vector<std::uint32_t>& ids, std::uint32_t i) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = mesh.triangles[i][static_cast<int>(k)];
    const glm::dvec3& p = mesh.positions[v];
    corners.point[k] = {p.x, p.y, p.z};
    corners.positionId[k] = ids[v];
  }
  return corners;
}

enum class Contact { none, crossing, coincident };

Contact classifyContact(const Corners& a, const Corners& b) {
  // Find shared corners.
  std::array<std::size_t, 3> ofA{}, ofB{};
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (a.positionId[i] == b.positionId[j]) {
        ofA[shared] = i;
        ofB[shared] = j;
        ++shared;
      }

  // Test by the number of shared corners.
  bool crosses = false;
  if (shared == 3) return Contact::coincident;
  if (shared == 2) {
    // Triangles with a common edge meet elsewhere only if one is folded onto the other.
    const Kernel::Point_3 &p = a.point[ofA[0]], &q = a.point[ofA[1]];
    const Kernel::Point_3 &r = a.point[3 - ofA[0] - ofA[1]], &s = b.point[3 - ofB[0] - ofB[1]];
    crosses = CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  } else if (shared == 1) {
    crosses = CGAL::do_intersect(a.acrossFrom(ofA[0]), b.triangle()) ||
              CGAL::do_intersect(b.acrossFrom(ofB[0]), a.triangle());
  } else {
    crosses = CGAL::do_intersect(a.triangle(), b.triangle());
  }
  return crosses ? Contact::crossing : Contact::none;
}

}  // namespace

Intersections findIntersections(const Mesh& mesh) {
  // Compute bounding boxes.
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 &p = mesh.positions[t.x], &q = mesh.positions[t.y], &r = mesh.positions[t.z];
    boxes.push_back({glm::min(p, glm::min(q, r)), glm::max(p, glm::max(q, r))});
  }

  // Mark triangles without area.
  std::vector<char> flat(mesh.triangles.size(), 0);
  const std::vector<std::uint32_t> ids = positionIds(mesh);
  for (std::uint32_t i = 0; i < flat.size(); ++i) {
    const Corners c = makeCorners(mesh, ids, i);
    flat[i] = CGAL::collinear(c.point[0], c.point[1], c.point[2]) ? 1 : 0;
  }

  // Test pairs with overlapping boxes exactly.
  Intersections result;
  std::mutex lock;
  result.complete = forOverlappingBoxes(
      boxes, boxes, kTestsPerTriangle * boxes.size() + kMinTests, [&](std::uint32_t i, std::uint32_t j) {
        if (i >= j || flat[i] != 0 || flat[j] != 0) return false;
        const Contact contact = classifyContact(makeCorners(mesh, ids, i), makeCorners(mesh, ids, j));
        if (contact == Contact::none) return true;
        const std::lock_guard guard(lock);
        (contact == Contact::crossing ? result.crossing : result.coincident).emplace_back(i, j);
        return true;
      });
  if (!result.complete) return {{}, {}, false};

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
