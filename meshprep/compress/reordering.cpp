#include "meshprep/compress/reordering.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include <oneapi/tbb/parallel_sort.h>

namespace malus::compress {

namespace {

// Triangle with its smallest corner first, rotated cyclically so that the orientation is kept, and its index.
struct CanonicalTriangle {
  glm::uvec3 corners;
  std::uint32_t index;
};

CanonicalTriangle canonical(const glm::uvec3& t, std::size_t index) {
  const auto at = static_cast<std::uint32_t>(index);
  if (t.y < t.x && t.y <= t.z) return {{t.y, t.z, t.x}, at};
  if (t.z < t.x && t.z < t.y) return {{t.z, t.x, t.y}, at};
  return {t, at};
}

auto key(const CanonicalTriangle& t) { return std::tie(t.corners.x, t.corners.y, t.corners.z, t.index); }

void sort(std::vector<CanonicalTriangle>& triangles) {
  oneapi::tbb::parallel_sort(triangles.begin(), triangles.end(),
                             [](const CanonicalTriangle& a, const CanonicalTriangle& b) { return key(a) < key(b); });
}

}  // namespace

std::optional<std::vector<std::uint32_t>> sourceTriangles(const TriangleMesh& source, const TriangleMesh& decoded,
                                                          std::span<const std::uint32_t> vertices) {
  // Compare counts.
  const std::size_t count = source.positions.size();
  if (decoded.positions.size() != count || vertices.size() != count ||
      decoded.normals.size() != source.normals.size() || decoded.triangles.size() != source.triangles.size())
    return std::nullopt;

  // Require each vertex once, with equal values.
  std::vector<bool> used(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = vertices[i];
    if (v >= count || used[v] || decoded.positions[i] != source.positions[v]) return std::nullopt;
    if (!source.normals.empty() && decoded.normals[i] != source.normals[v]) return std::nullopt;
    used[v] = true;
  }

  // Require each triangle once, with equal orientation.
  std::vector<CanonicalTriangle> before, after;
  before.reserve(source.triangles.size());
  after.reserve(source.triangles.size());
  for (std::size_t i = 0; i < source.triangles.size(); ++i) {
    const glm::uvec3& t = decoded.triangles[i];
    before.push_back(canonical(source.triangles[i], i));
    after.push_back(canonical({vertices[t.x], vertices[t.y], vertices[t.z]}, i));
  }
  sort(before);
  sort(after);
  std::vector<std::uint32_t> triangles(source.triangles.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].corners != after[i].corners) return std::nullopt;
    triangles[after[i].index] = before[i].index;
  }
  return triangles;
}

}  // namespace malus::compress
