#include "meshprep/normals/piece_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "meshprep/clean/disjoint_sets.h"
#include "meshprep/clean/edges.h"

namespace malus::prep {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kCancelled = 1e-6;  // of the sum of weights: what is left has no direction

// Unit length, or zero; scaled by the largest component first, so that tiny and huge edges stay in the range of double.
glm::dvec3 direction(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0);
}

double cornerAngle(const glm::dvec3& at, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 u = direction(b - at), v = direction(c - at);
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
  constexpr std::size_t kGrain = 4096;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, triangleCount, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const glm::uvec3 t = mesh.triangles[i];
      const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      faceNormals[i] = faceNormal(a, b, c);
      cornerAngles[i] = {cornerAngle(a, b, c), cornerAngle(b, c, a), cornerAngle(c, a, b)};
    }
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

  // Step 3: sum weighted normals, a sum for each piece, kept at its first corner.
  std::vector<glm::dvec3> sums(3 * triangleCount, glm::dvec3(0));
  std::vector<double> weights(3 * triangleCount, 0.0);
  for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner) {
    const double angle = cornerAngles[corner / 3][static_cast<int>(corner % 3)];
    const std::uint32_t piece = pieces.find(corner);
    sums[piece] += angle * faceNormals[corner / 3];
    weights[piece] += angle;
  }

  // Step 4: pieces of every vertex, in the order of their first corners.
  std::vector<std::vector<std::uint32_t>> vertexPieces(mesh.positions.size());
  for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner)
    if (pieces.find(corner) == corner)
      vertexPieces[mesh.triangles[corner / 3][static_cast<int>(corner % 3)]].push_back(corner);

  // Step 5: a stored vertex for each.
  NormalCounts counts;
  std::vector<std::uint32_t> newVertex(3 * triangleCount, kNone);
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<std::uint32_t> sources;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (vertexPieces[v].empty()) {  // of no triangle: it stays, with any normal
      positions.push_back(mesh.positions[v]);
      if (!mesh.sourceVertices.empty()) sources.push_back(mesh.sourceVertices[v]);
      normals.emplace_back(0, 0, 1);
    }
    for (const std::uint32_t piece : vertexPieces[v]) {
      newVertex[piece] = static_cast<std::uint32_t>(positions.size());
      positions.push_back(mesh.positions[v]);
      if (!mesh.sourceVertices.empty()) sources.push_back(mesh.sourceVertices[v]);
      const double length = glm::length(sums[piece]);
      const bool cancelled = length <= kCancelled * weights[piece];
      counts.undefined += cancelled ? 1u : 0u;
      const glm::dvec3 normal = cancelled ? faceNormals[piece / 3] : sums[piece] / length;
      normals.emplace_back(normal == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : normal);  // of what has no area, any
    }
  }
  counts.added = positions.size() - mesh.positions.size();
  for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner)
    mesh.triangles[corner / 3][static_cast<int>(corner % 3)] = newVertex[pieces.find(corner)];
  mesh.positions = std::move(positions);
  mesh.normals = std::move(normals);
  mesh.sourceVertices = std::move(sources);
  return counts;
}

}  // namespace malus::prep
