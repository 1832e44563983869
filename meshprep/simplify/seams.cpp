#include "meshprep/simplify/seams.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "meshprep/clean/disjoint_sets.h"
#include "meshprep/clean/edges.h"
#include "meshprep/simplify/surface.h"

namespace malus::prep {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool areEqual(const CornerTexture& a, const CornerTexture& b) {
  return a.coordinates == b.coordinates && a.tangent == b.tangent && a.isMissing == b.isMissing;
}

}  // namespace

Seams::Seams(Mesh& mesh) : sourceVertices_(mesh.sourceVertices) {
  if (sourceVertices_.empty()) {
    sourceVertices_.resize(mesh.positions.size());
    std::iota(sourceVertices_.begin(), sourceVertices_.end(), 0u);
  }

  // Join the corners at both ends of the edges whose sides have equal attributes.
  const auto corners = static_cast<std::uint32_t>(mesh.cornerTextures.size());
  DisjointSets pieces(corners);
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].forward == edge[1].forward) return;
    const auto begin = [](const EdgeUse& use) { return 3 * use.triangle + use.corner; };
    const auto end = [](const EdgeUse& use) { return 3 * use.triangle + (use.corner + 1u) % 3; };
    const auto match = [&](std::uint32_t a, std::uint32_t b) {
      return areEqual(mesh.cornerTextures[a], mesh.cornerTextures[b]);
    };
    if (!match(begin(edge[0]), end(edge[1])) || !match(end(edge[0]), begin(edge[1]))) return;
    pieces.merge(begin(edge[0]), end(edge[1]));
    pieces.merge(end(edge[0]), begin(edge[1]));
  });

  // Make a vertex of each piece. A vertex of no triangle is dropped.
  std::vector<std::uint32_t> vertexIds(corners, kNone);
  std::vector<glm::dvec3> positions;
  for (std::uint32_t corner = 0; corner < corners; ++corner) {
    std::uint32_t& vertex = vertexIds[pieces.find(corner)];
    std::uint32_t& old = mesh.triangles[corner / 3][static_cast<int>(corner % 3)];
    if (vertex == kNone) {
      vertex = static_cast<std::uint32_t>(positions.size());
      positions.push_back(mesh.positions[old]);
      before_.push_back(old);
      textures_.push_back(mesh.cornerTextures[corner]);
    }
    old = vertex;
  }
  mesh.positions = std::move(positions);
  mesh.normals.clear();
  mesh.cornerTextures.clear();
  mesh.sourceCorners.clear();
  mesh.sourceVertices.resize(mesh.positions.size());
  std::iota(mesh.sourceVertices.begin(), mesh.sourceVertices.end(), 0u);
}

void Seams::join(Mesh& mesh) const {
  // Number the vertices before the cut that are left, in their order.
  std::vector<std::uint32_t> number(sourceVertices_.size(), kNone);
  for (const std::uint32_t piece : mesh.sourceVertices) number[before_[piece]] = 0;
  std::uint32_t count = 0;
  std::vector<std::uint32_t> sources;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != kNone) {
      number[v] = count++;
      sources.push_back(sourceVertices_[v]);
    }
  std::vector<glm::dvec3> positions(count);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    positions[number[before_[mesh.sourceVertices[v]]]] = mesh.positions[v];

  // Set the corners.
  for (glm::uvec3& t : mesh.triangles) {
    glm::uvec3 joined(0), source(0);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t piece = mesh.sourceVertices[t[k]];
      mesh.cornerTextures.push_back(textures_[piece]);
      joined[k] = number[before_[piece]];
      source[k] = sources[joined[k]];
    }
    t = joined;
    mesh.sourceCorners.push_back(source);
  }
  mesh.positions = std::move(positions);
  mesh.sourceVertices = std::move(sources);
}

double Seams::imageDeviation(const Mesh& before, const Mesh& after, double reach) const {
  const Surface surface(after);
  double largest = 0;
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    const glm::dvec3& p = before.positions[v];
    double smallest = std::numeric_limits<double>::infinity();
    surface.forEachWithin(
        p, reach, [&](std::uint32_t i) { smallest = std::min(smallest, imageDistance(after, i, p, textures_[v])); });
    if (smallest < std::numeric_limits<double>::infinity()) largest = std::max(largest, smallest);
  }
  return largest;
}

double Seams::imageDistance(const Mesh& mesh, std::uint32_t triangle, const glm::dvec3& p,
                            const CornerTexture& texture) const {
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a = mesh.positions[t.x], edge1 = mesh.positions[t.y] - a, edge2 = mesh.positions[t.z] - a;
  const glm::dvec3 normal = glm::cross(edge1, edge2);
  const double area = glm::dot(normal, normal);
  if (!(area > 0)) return std::numeric_limits<double>::infinity();
  const double y = glm::dot(glm::cross(p - a, edge2), normal) / area,
               z = glm::dot(glm::cross(edge1, p - a), normal) / area;
  double largest = 0;
  for (std::size_t set = 0; set < texture.coordinates.size(); ++set) {
    if (!mesh.hasCoordinates[set]) continue;
    const auto uv = [&](std::uint32_t v) { return glm::dvec2(textures_[mesh.sourceVertices[v]].coordinates[set]); };
    const glm::dvec2 d1 = uv(t.y) - uv(t.x), d2 = uv(t.z) - uv(t.x);
    const double imageArea = std::abs(d1.x * d2.y - d1.y * d2.x);
    const glm::dvec2 error = uv(t.x) + y * d1 + z * d2 - glm::dvec2(texture.coordinates[set]);
    if (imageArea > 0) largest = std::max(largest, glm::length(error) * std::sqrt(std::sqrt(area) / imageArea));
  }
  return largest;
}

}  // namespace malus::prep
