#include "meshprep/simplify/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace malus::prep {

namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::size_t kStackSize = 96;  // medians halve the triangles: at most 32 levels with 2 entries each

double distanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * ab);
}

}  // namespace

double distanceToTriangle(const glm::dvec3& p, const TriangleCorners& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);

  // The projection is inside the triangle if it is on the inner side of all edges.
  const bool inside = length > 0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0 &&
                      glm::dot(glm::cross(c - b, p - b), normal) >= 0 &&
                      glm::dot(glm::cross(a - c, p - c), normal) >= 0;
  if (inside) return std::abs(glm::dot(p - a, normal)) / length;
  return std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
}

Surface::Surface(const Mesh& mesh) : order_(mesh.triangles.size()) {
  corners_.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles)
    corners_.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(corners_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(order_.size()));
}

void Surface::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  // Bound the triangles.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low(kInfinity), high(-kInfinity);
  for (std::uint32_t i = begin; i < end; ++i)
    for (const glm::dvec3& p : corners_[order_[i]]) low = glm::min(low, p), high = glm::max(high, p);
  nodes_[node].low = low;
  nodes_[node].high = high;
  nodes_[node].begin = begin;
  nodes_[node].end = end;
  if (end - begin <= kLeafTriangles) return;

  // Split at the median along the longest axis; equal centres are ordered by their triangles.
  const glm::dvec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto centre = [&](std::uint32_t t) {
    return corners_[t][0][axis] + corners_[t][1][axis] + corners_[t][2][axis];
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = centre(a), y = centre(b);
                     return x != y ? x < y : a < b;
                   });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].left = left;
  build(left, begin, middle);
  build(left + 1, middle, end);
}

double Surface::boxDistance2(const Node& node, const glm::dvec3& point) const {
  const glm::dvec3 outside = glm::max(glm::max(node.low - point, point - node.high), glm::dvec3(0));
  return glm::dot(outside, outside);
}

Surface::Nearest Surface::nearest(const glm::dvec3& point) const {
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  struct Entry {
    std::uint32_t node;
    double distance2;
  };
  std::array<Entry, kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = {0, boxDistance2(nodes_[0], point)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance2 > best.distance * best.distance) continue;
    const Node& node = nodes_[entry.node];
    if (node.left == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const double distance = distanceToTriangle(point, corners_[order_[i]]);
        if (distance < best.distance) best = {distance, order_[i]};
      }
      continue;
    }
    // Visit the nearer child first.
    const double left = boxDistance2(nodes_[node.left], point), right = boxDistance2(nodes_[node.left + 1], point);
    const Entry near = left <= right ? Entry{node.left, left} : Entry{node.left + 1, right};
    const Entry far = left <= right ? Entry{node.left + 1, right} : Entry{node.left, left};
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

void Surface::forEachWithin(const glm::dvec3& point, double radius,
                            const std::function<void(std::uint32_t)>& visit) const {
  std::array<std::uint32_t, kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (boxDistance2(node, point) > radius * radius) continue;
    if (node.left != 0) {
      stack[size++] = node.left;
      stack[size++] = node.left + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      if (distanceToTriangle(point, corners_[order_[i]]) <= radius) visit(order_[i]);
  }
}

}  // namespace malus::prep
