#include "meshprep/normals/piece_normals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "meshprep/base/bucket_sort.h"
#include "meshprep/base/parallel_blocks.h"
#include "meshprep/clean/disjoint_sets.h"
#include "meshprep/clean/edges.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kCancelled = 1e-6;  // of the sum of weights: what is left has no direction

// Unit length, or zero; scaled by the largest component first, so that tiny and huge edges stay in the range of double.
glm::dvec3 direction(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0);
}

// Between two vectors of unit length.
double angleBetween(const glm::dvec3& u, const glm::dvec3& v) {
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

}  // namespace

// Any two edges give it; their lengths do not matter.
glm::dvec3 faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return direction(glm::cross(direction(b - a), direction(c - a)));
}

NormalCounts addPieceNormals(Mesh& mesh, const IsSmooth& isSmooth) {
  // Step 1: normals of the triangles and angles of their corners.
  const std::size_t triangleCount = mesh.triangles.size();
  std::vector<glm::dvec3> faceNormals(triangleCount);
  std::vector<glm::dvec3> cornerAngles(triangleCount);
  forNumbers(triangleCount, [&](std::size_t i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const glm::dvec3 ab = direction(b - a), bc = direction(c - b), ac = direction(c - a);
    faceNormals[i] = direction(glm::cross(ab, ac));
    cornerAngles[i] = {angleBetween(ab, ac), angleBetween(bc, 0.0 - ab), angleBetween(0.0 - ac, 0.0 - bc)};
  });

  // Step 2: merge the corners at both ends of every smooth edge.
  DisjointSets pieces(3 * triangleCount);
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].forward == edge[1].forward) return;
    const std::uint32_t a = edge[0].triangle, b = edge[1].triangle;
    if (!isSmooth(a, b, faceNormals[a], faceNormals[b])) return;
    const auto begin = [](const EdgeUse& use) { return 3 * use.triangle + use.corner; };
    const auto end = [](const EdgeUse& use) { return 3 * use.triangle + (use.corner + 1u) % 3; };
    pieces.merge(begin(edge[0]), end(edge[1]));
    pieces.merge(end(edge[0]), begin(edge[1]));
  });

  // Step 3: a stored vertex for every piece of every vertex, in the order of their first corners. A vertex of no
  // triangle stays.
  const auto vertexAt = [&](std::uint32_t corner) -> std::uint32_t& {
    return mesh.triangles[corner / 3][static_cast<int>(corner % 3)];
  };
  const auto forPieces = [&](auto visit) {
    for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner)
      if (pieces.find(corner) == corner) visit(vertexAt(corner), corner);
  };
  const auto sorted = sortInBuckets<std::uint32_t>(mesh.positions.size(), forPieces, std::less<>());
  std::vector<std::uint32_t> oldVertex, firstCorner, newVertex(3 * triangleCount, kNone);
  oldVertex.reserve(sorted.items.size());
  firstCorner.reserve(sorted.items.size());
  const auto store = [&](std::uint32_t vertex, std::uint32_t corner) {
    oldVertex.push_back(vertex);
    firstCorner.push_back(corner);
  };
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (sorted.first[v] == sorted.first[v + 1]) store(v, kNone);
    for (std::uint32_t i = sorted.first[v]; i < sorted.first[v + 1]; ++i) {
      newVertex[sorted.items[i]] = static_cast<std::uint32_t>(oldVertex.size());
      store(v, sorted.items[i]);
    }
  }

  // Step 4: sum weighted normals.
  std::vector<glm::dvec3> sums(oldVertex.size(), glm::dvec3(0));
  std::vector<double> weights(oldVertex.size(), 0.0);
  for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner) {
    const double angle = cornerAngles[corner / 3][static_cast<int>(corner % 3)];
    const std::uint32_t vertex = newVertex[pieces.find(corner)];
    sums[vertex] += angle * faceNormals[corner / 3];
    weights[vertex] += angle;
    vertexAt(corner) = vertex;
  }

  // Step 5: normals. What has no area, or no triangle, gets any.
  NormalCounts counts;
  counts.added = oldVertex.size() - mesh.positions.size();
  mesh.normals.assign(oldVertex.size(), glm::vec3(0, 0, 1));
  for (std::size_t v = 0; v < oldVertex.size(); ++v) {
    if (firstCorner[v] == kNone) continue;
    const double length = glm::length(sums[v]);
    const bool cancelled = length <= kCancelled * weights[v];
    counts.undefined += cancelled ? 1u : 0u;
    const glm::dvec3 normal = cancelled ? faceNormals[firstCorner[v] / 3] : sums[v] / length;
    if (normal != glm::dvec3(0)) mesh.normals[v] = glm::vec3(normal);
  }
  mesh.positions = selected(mesh.positions, oldVertex);
  if (!mesh.sourceVertices.empty()) mesh.sourceVertices = selected(mesh.sourceVertices, oldVertex);
  return counts;
}

}  // namespace malus::prep
