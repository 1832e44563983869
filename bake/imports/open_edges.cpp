#include "bake/imports/open_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/weld.h"

namespace malus::bake {

namespace {

void makeWeldedMesh(std::span<const prep::Polygons* const> pieces, const prep::Options& preparation,
                    double relativeTolerance, OpenEdges& result) {
  prep::Mesh& mesh = result.mesh;
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    const prep::Polygons& polygons = *pieces[piece];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), polygons.positions.begin(), polygons.positions.end());
    for (std::size_t f = 0; f < polygons.faceCount(); ++f) {
      const auto face = polygons.face(f);
      for (const std::uint32_t corner : face)
        low = glm::min(low, polygons.positions[corner]), high = glm::max(high, polygons.positions[corner]);
      for (std::size_t c = 2; c < face.size(); ++c) {
        result.corners.emplace_back(face[0], face[c - 1], face[c]);
        mesh.triangles.push_back(result.corners.back() + first);
      }
    }
    result.pieceOf.resize(mesh.triangles.size(), piece);
  }
  if (mesh.triangles.empty()) return;
  const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
  prep::weld(mesh, std::max({preparation.steps.weldTolerance, preparation.weldRelative * glm::distance(low, high),
                             relativeTolerance * std::max({farthest.x, farthest.y, farthest.z})}));

  // Drop triangles that are lines or points.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
    result.pieceOf[kept] = result.pieceOf[i];
    result.corners[kept] = result.corners[i];
    mesh.triangles[kept++] = t;
  }
  mesh.triangles.resize(kept);
  result.pieceOf.resize(kept);
  result.corners.resize(kept);
}

}  // namespace

OpenEdges findOpenEdges(std::span<const prep::Polygons* const> pieces, const prep::Options& preparation,
                        double relativeTolerance) {
  OpenEdges result;
  makeWeldedMesh(pieces, preparation, relativeTolerance, result);
  const prep::Mesh& mesh = result.mesh;
  result.counts.resize(pieces.size(), 0);
  result.isShared.resize(mesh.positions.size(), 0);
  std::map<std::pair<std::size_t, std::size_t>, Neighbours> found;
  prep::forEachEdge(prep::edgeUses(mesh.triangles), [&](std::span<const prep::EdgeUse> edge) {
    // Uses are sorted by triangle, and therefore by piece.
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < edge.size(); ++i) {
      const std::size_t piece = result.pieceOf[edge[i].triangle];
      const bool alone = (i == 0 || result.pieceOf[edge[i - 1].triangle] != piece) &&
                         (i + 1 == edge.size() || result.pieceOf[edge[i + 1].triangle] != piece);
      if (alone) open.push_back(piece);
    }
    for (const std::size_t piece : open) ++result.counts[piece];
    for (std::size_t i = 1; i < open.size(); ++i) {
      const std::pair<std::size_t, std::size_t> pair = std::minmax(open[i - 1], open[i]);
      Neighbours& neighbours = found[pair];
      if (neighbours.edges++ == 0)
        neighbours = {pair.first, pair.second, 1, mesh.positions[edge[0].low], mesh.positions[edge[0].high]};
      result.isShared[edge[0].low] = result.isShared[edge[0].high] = 1;
    }
  });
  result.neighbours.reserve(found.size());
  for (const auto& [pair, neighbours] : found) result.neighbours.push_back(neighbours);
  return result;
}

}  // namespace malus::bake
