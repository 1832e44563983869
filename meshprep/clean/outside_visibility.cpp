#include "meshprep/clean/outside_visibility.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <tbb/parallel_for.h>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace malus::prep {

namespace {

namespace bg = boost::geometry;

using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<Point>;
using Segment = bg::model::segment<Point>;
using Entry = std::pair<TreeBox, std::uint32_t>;

constexpr std::size_t kSamples = 32;
constexpr int kDirections = 12;
constexpr double kOffset = 1e-7;  // of a ray's origin from the surface, relative to the size of the mesh

Point treePoint(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

// Directions of a hemisphere around z, evenly by solid angle. Source: R. Swinbank and R. J. Purser, "Fibonacci grids: a
// novel approach to global modelling", Quarterly Journal of the Royal Meteorological Society 132, 2006.
std::array<glm::dvec3, kDirections> hemisphere() {
  std::array<glm::dvec3, kDirections> directions{};
  for (int i = 0; i < kDirections; ++i) {
    const double z = (i + 0.5) / kDirections, r = std::sqrt(1 - z * z),
                 angle = 2 * std::numbers::pi * i / std::numbers::phi;
    directions[static_cast<std::size_t>(i)] = {r * std::cos(angle), r * std::sin(angle), z};
  }
  return directions;
}

// Source: T. Moeller and B. Trumbore, "Fast, minimum storage ray/triangle intersection", Journal of Graphics Tools
// 2(1), 1997.
bool hits(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b,
          const glm::dvec3& c) {
  const glm::dvec3 u = b - a, v = c - a, p = glm::cross(direction, v);
  const double determinant = glm::dot(u, p);
  if (determinant == 0) return false;
  const glm::dvec3 toOrigin = origin - a;
  const double first = glm::dot(toOrigin, p) / determinant;
  if (!(first >= 0 && first <= 1)) return false;
  const glm::dvec3 q = glm::cross(toOrigin, u);
  const double second = glm::dot(direction, q) / determinant;
  return second >= 0 && first + second <= 1 && glm::dot(v, q) / determinant > 0;
}

}  // namespace

struct OutsideVisibility::Index {
  bg::index::rtree<Entry, bg::index::quadratic<16>> tree;
  double size = 0;  // diagonal of the bounding box
};

OutsideVisibility::OutsideVisibility(const Mesh& mesh) : mesh_(mesh), index_(std::make_unique<Index>()) {
  std::vector<Entry> entries;
  entries.reserve(mesh.triangles.size());
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const glm::dvec3 from = glm::min(a, glm::min(b, c)), to = glm::max(a, glm::max(b, c));
    entries.emplace_back(TreeBox(treePoint(from), treePoint(to)), i);
    low = glm::min(low, from);
    high = glm::max(high, to);
  }
  index_->size = glm::distance(low, high);
  index_->tree = decltype(index_->tree)(entries);
}

OutsideVisibility::~OutsideVisibility() = default;

VisibleShares OutsideVisibility::sample(std::span<const std::uint32_t> triangles,
                                        const std::vector<char>& flipped) const {
  // Sum the areas.
  std::vector<double> sums;
  sums.reserve(triangles.size());
  double area = 0;
  const auto normal = [&](std::uint32_t i) {
    const glm::uvec3& t = mesh_.triangles[i];
    const glm::dvec3 n =
        glm::cross(mesh_.positions[t.y] - mesh_.positions[t.x], mesh_.positions[t.z] - mesh_.positions[t.x]);
    return flipped[i] != 0 ? -n : n;
  };
  for (const std::uint32_t i : triangles) sums.push_back(area += glm::length(normal(i)));
  if (!(area > 0)) return {};

  // Trace rays from the centroids of triangles at even distances of area.
  static const std::array<glm::dvec3, kDirections> kHemisphere = hemisphere();
  const auto isFree = [&](const glm::dvec3& origin, const glm::dvec3& direction) {
    const Segment ray(treePoint(origin), treePoint(origin + 2 * index_->size * direction));
    for (auto entry = index_->tree.qbegin(bg::index::intersects(ray)); entry != index_->tree.qend(); ++entry) {
      const glm::uvec3& t = mesh_.triangles[entry->second];
      if (hits(origin, direction, mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z])) return false;
    }
    return true;
  };
  std::array<std::atomic<std::size_t>, 2> free{};
  tbb::parallel_for(std::size_t{0}, kSamples, [&](std::size_t s) {
    const double target = area * (static_cast<double>(s) + 0.5) / kSamples;
    const auto found = std::min(std::lower_bound(sums.begin(), sums.end(), target), sums.end() - 1);
    const std::uint32_t i = triangles[static_cast<std::size_t>(found - sums.begin())];
    const glm::uvec3& t = mesh_.triangles[i];
    const glm::dvec3 centre = (mesh_.positions[t.x] + mesh_.positions[t.y] + mesh_.positions[t.z]) / 3.0;
    const glm::dvec3 n = glm::normalize(normal(i));
    const glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, n)), v = glm::cross(n, u);
    for (std::size_t side = 0; side < 2; ++side)
      for (const glm::dvec3& local : kHemisphere) {
        const double sign = side == 0 ? 1 : -1;
        const glm::dvec3 direction = local.x * u + local.y * v + sign * local.z * n;
        if (isFree(centre + sign * kOffset * index_->size * n, direction)) ++free[side];
      }
  });
  constexpr double kRays = static_cast<double>(kSamples) * kDirections;
  return {static_cast<double>(free[0]) / kRays, static_cast<double>(free[1]) / kRays};
}

}  // namespace malus::prep
