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
#include "meshprep/clean/places.h"

namespace malus::prep {

namespace {

constexpr std::uint64_t kCandidatesEach = 8;  // of an edge, on average; its own ends are two
constexpr std::uint64_t kCandidatesMore = 1u << 20u;

}  // namespace

Junctions findJunctions(const Mesh& mesh) {
  // Step 1: boundary edges and their vertices.
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

  // Step 2: those that may meet.
  std::vector<Box> edgeBoxes, vertexBoxes;
  for (const EdgeUse& edge : edges) {
    const glm::dvec3 a = mesh.positions[edge.low], b = mesh.positions[edge.high];
    const glm::dvec3 room(kJunctionTolerance * glm::distance(a, b));
    edgeBoxes.push_back({glm::min(a, b) - room, glm::max(a, b) + room});
  }
  for (const std::uint32_t v : vertices) vertexBoxes.push_back({mesh.positions[v], mesh.positions[v]});
  const std::vector<std::uint32_t> place = placeOfVertices(mesh);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::mutex lock;
  result.complete = forOverlappingBoxes(
      edgeBoxes, vertexBoxes, kCandidatesEach * edges.size() + kCandidatesMore, [&](std::uint32_t e, std::uint32_t i) {
        const EdgeUse& edge = edges[e];
        const std::uint32_t v = vertices[i];
        if (place[v] == place[edge.low] || place[v] == place[edge.high]) return true;
        const glm::dvec3 along = mesh.positions[edge.high] - mesh.positions[edge.low];
        const glm::dvec3 toVertex = mesh.positions[v] - mesh.positions[edge.low];
        const double share = glm::dot(toVertex, along) / glm::dot(along, along);
        const double off = glm::distance(toVertex, share * along);
        if (!(share > 0 && share < 1 && off <= kJunctionTolerance * glm::length(along))) return true;
        const std::lock_guard guard(lock);
        pairs.emplace_back(v, e);
        return true;
      });
  if (!result.complete) return result;

  // Step 3: in an order that does not depend on the threads.
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [v, e] : pairs)
    result.found.add([&, vertex = v, edge = edges[e]] {
      return findingAt(mesh, mesh.positions[vertex], {edge.triangle}, {vertex, edge.low, edge.high});
    });
  return result;
}

}  // namespace malus::prep
