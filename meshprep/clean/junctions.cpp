#include "meshprep/clean/junctions.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/clean/box_pairs.h"
#include "meshprep/clean/edges.h"
#include "meshprep/clean/position_ids.h"

namespace malus::prep {

namespace {

constexpr std::uint64_t kCandidatesPerEdge = 8;  // average, including the two ends
constexpr std::uint64_t kMinCandidates = 1u << 20u;

}  // namespace

Junctions findJunctions(const Mesh& mesh) {
  // Find boundary edges and their vertices.
  std::vector<EdgeUse> edges;
  std::vector<std::uint32_t> vertices;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 1) return;
    edges.push_back(edge[0]);
    vertices.push_back(edge[0].low);
    vertices.push_back(edge[0].high);
  });
  Junctions result;
  if (edges.empty()) return result;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  // Find vertices near edges.
  std::vector<Box> edgeBoxes, vertexBoxes;
  for (const EdgeUse& edge : edges) {
    const glm::dvec3 a = mesh.positions[edge.low], b = mesh.positions[edge.high];
    const glm::dvec3 margin(kJunctionTolerance * glm::distance(a, b));
    edgeBoxes.push_back({glm::min(a, b) - margin, glm::max(a, b) + margin});
  }
  for (const std::uint32_t v : vertices) vertexBoxes.push_back({mesh.positions[v], mesh.positions[v]});
  const std::vector<std::uint32_t> ids = positionIds(mesh);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::mutex lock;
  result.complete = forOverlappingBoxes(
      edgeBoxes, vertexBoxes, kCandidatesPerEdge * edges.size() + kMinCandidates,
      [&](std::uint32_t e, std::uint32_t i) -> std::uint32_t {
        const EdgeUse& edge = edges[e];
        const std::uint32_t v = vertices[i];
        if (ids[v] == ids[edge.low] || ids[v] == ids[edge.high]) return 1;
        const glm::dvec3 direction = mesh.positions[edge.high] - mesh.positions[edge.low];
        const glm::dvec3 toVertex = mesh.positions[v] - mesh.positions[edge.low];
        const double fraction = glm::dot(toVertex, direction) / glm::dot(direction, direction);
        const double distance = glm::distance(toVertex, fraction * direction);
        if (!(fraction > 0 && fraction < 1 && distance <= kJunctionTolerance * glm::length(direction))) return 1;
        const std::lock_guard guard(lock);
        pairs.emplace_back(v, e);
        return 1;
      });
  if (!result.complete) return result;

  // Sort, because the order of the threads varies.
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [v, e] : pairs)
    result.found.add([&, vertex = v, edge = edges[e]] {
      return findingAt(mesh, mesh.positions[vertex], {edge.triangle}, {vertex, edge.low, edge.high});
    });
  return result;
}

}  // namespace malus::prep
