#include "meshprep/normals/crease_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "meshprep/clean/edges.h"

namespace malus::prep {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kCosineTolerance = 1e-6;  // an edge of exactly the crease angle is smooth, rounding or not
constexpr double kCancelled = 1e-6;        // of the sum of weights: what is left has no direction

// Sets of corners (3 * triangle + corner), merged as smooth edges are found.
class Pieces {
 public:
  explicit Pieces(std::size_t corners) : parent_(corners) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  // The smaller corner stands for the set, so results do not depend on the order of merging.
  void merge(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Unit length; scaled by the largest component first, so that tiny and huge edges stay in the range of double.
glm::dvec3 direction(const glm::dvec3& v) {
  return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

// Any two edges give it; their lengths do not matter.
glm::dvec3 faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return direction(glm::cross(direction(b - a), direction(c - a)));
}

double cornerAngle(const glm::dvec3& at, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 u = direction(b - at), v = direction(c - at);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

}  // namespace

NormalCounts addCreaseNormals(Mesh& mesh, double creaseDegrees) {
  // Step 1: normals of the triangles.
  const std::size_t triangleCount = mesh.triangles.size();
  std::vector<glm::dvec3> faceNormals(triangleCount);
  for (std::size_t i = 0; i < triangleCount; ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    faceNormals[i] = faceNormal(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
  }

  // Step 2: merge the corners at both ends of every smooth edge.
  Pieces pieces(3 * triangleCount);
  const double minCosine = std::cos(glm::radians(creaseDegrees)) - kCosineTolerance;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].forward == edge[1].forward) return;
    if (glm::dot(faceNormals[edge[0].triangle], faceNormals[edge[1].triangle]) < minCosine) return;
    const auto begin = [](const EdgeUse& use) { return 3 * use.triangle + use.corner; };
    const auto end = [](const EdgeUse& use) { return 3 * use.triangle + (use.corner + 1u) % 3; };
    pieces.merge(begin(edge[0]), end(edge[1]));
    pieces.merge(end(edge[0]), begin(edge[1]));
  });

  // Step 3: sum weighted normals, a sum for each piece, kept at its first corner.
  std::vector<glm::dvec3> sums(3 * triangleCount, glm::dvec3(0));
  std::vector<double> weights(3 * triangleCount, 0.0);
  for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner) {
    const glm::uvec3 t = mesh.triangles[corner / 3];
    const int at = static_cast<int>(corner % 3);
    const double angle =
        cornerAngle(mesh.positions[t[at]], mesh.positions[t[(at + 1) % 3]], mesh.positions[t[(at + 2) % 3]]);
    const std::uint32_t piece = pieces.find(corner);
    sums[piece] += angle * faceNormals[corner / 3];
    weights[piece] += angle;
  }

  // Step 4: pieces of every vertex, in the order of their first corners.
  std::vector<std::vector<std::uint32_t>> piecesOf(mesh.positions.size());
  for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner)
    if (pieces.find(corner) == corner)
      piecesOf[mesh.triangles[corner / 3][static_cast<int>(corner % 3)]].push_back(corner);

  // Step 5: a stored vertex for each.
  NormalCounts counts;
  std::vector<std::uint32_t> vertexOf(3 * triangleCount, kNone);
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (const std::uint32_t piece : piecesOf[v]) {
      vertexOf[piece] = static_cast<std::uint32_t>(positions.size());
      positions.push_back(mesh.positions[v]);
      const double length = glm::length(sums[piece]);
      const bool cancelled = length <= kCancelled * weights[piece];
      counts.undefined += cancelled ? 1u : 0u;
      normals.emplace_back(cancelled ? faceNormals[piece / 3] : sums[piece] / length);
    }
  }
  counts.added = positions.size() - mesh.positions.size();
  for (std::uint32_t corner = 0; corner < 3 * triangleCount; ++corner)
    mesh.triangles[corner / 3][static_cast<int>(corner % 3)] = vertexOf[pieces.find(corner)];
  mesh.positions = std::move(positions);
  mesh.normals = std::move(normals);
  return counts;
}

}  // namespace malus::prep
