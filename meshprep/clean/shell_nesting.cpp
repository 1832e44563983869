#include "meshprep/clean/shell_nesting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vector_relational.hpp>

namespace malus::prep {

namespace {

constexpr std::size_t kSamples = 16;
constexpr double kInside = 0.75;
constexpr std::uint64_t kMaxWork = 1u << 28u;  // solid angles: some seconds

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Box boundingBox(const Shell& shell, std::span<const glm::dvec3> positions) {
  Box box;
  for (const glm::uvec3& t : shell.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      box.low = glm::min(box.low, positions[t[corner]]);
      box.high = glm::max(box.high, positions[t[corner]]);
    }
  return box;
}

bool isWithin(const Box& inner, const Box& outer) {
  return glm::all(glm::greaterThanEqual(inner.low, outer.low)) && glm::all(glm::lessThanEqual(inner.high, outer.high));
}

bool isInside(const Shell& inner, const Shell& outer, std::span<const glm::dvec3> positions, std::uint64_t& work) {
  const std::size_t count = std::min(kSamples, inner.triangles.size());
  for (std::size_t i = 0; i < count; ++i) {
    work += outer.triangles.size();
    const glm::dvec3 p = positions[inner.triangles[i * inner.triangles.size() / count].x];
    if (std::abs(windingNumber(outer, positions, p)) <= kInside) return false;
  }
  return true;
}

}  // namespace

double windingNumber(const Shell& shell, std::span<const glm::dvec3> positions, const glm::dvec3& p) {
  double solidAngle = 0;
  for (const glm::uvec3& t : shell.triangles) {
    const glm::dvec3 a = positions[t.x] - p, b = positions[t.y] - p, c = positions[t.z] - p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double numerator = glm::dot(a, glm::cross(b, c));
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    solidAngle += 2 * std::atan2(numerator, denominator);
  }
  return solidAngle / (4 * glm::pi<double>());
}

bool nestShells(std::span<const Shell> shells, std::span<const glm::dvec3> positions, std::vector<Nesting>& nesting) {
  std::vector<Box> boxes;
  for (const Shell& shell : shells) boxes.push_back(boundingBox(shell, positions));

  // Process shells by decreasing volume, so that parents come before their children.
  std::vector<std::size_t> order(shells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return shells[a].volume > shells[b].volume; });
  nesting.assign(shells.size(), {});
  std::uint64_t work = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t inner = order[i];
    for (std::size_t j = i; j-- > 0;) {
      const std::size_t outer = order[j];
      if (!isWithin(boxes[inner], boxes[outer]) || !isInside(shells[inner], shells[outer], positions, work)) continue;
      nesting[inner] = {outer, nesting[outer].depth + 1};
      break;
    }
    if (work > kMaxWork) {
      nesting.assign(shells.size(), {});
      return false;
    }
  }
  return true;
}

}  // namespace malus::prep
