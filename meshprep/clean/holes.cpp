#include "meshprep/clean/holes.h"

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/degenerate_faces.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/clean/select.h"
#include "meshprep/clean/triangulate.h"

namespace malus::prep {

namespace {

Finding describeHole(const Mesh& mesh, const Loop& loop, std::string_view remark) {
  Finding finding;
  double around = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    finding.at += mesh.positions[loop[i]] / static_cast<double>(loop.size());
    around += glm::distance(mesh.positions[loop[i]], mesh.positions[loop[(i + 1) % loop.size()]]);
    if (sourceVertex(mesh, loop[i]) != kNoSource) finding.vertices.push_back(sourceVertex(mesh, loop[i]));
  }
  finding.what = fmt::format("{} edges, {:.4g} m around{}", loop.size(), around, remark);
  return finding;
}

// Cap of a hole, from this triangle on.
struct Cap {
  const Loop* loop;
  std::size_t firstTriangle;
};

// Removes the caps that touch the surface, or an earlier cap that is kept, elsewhere than at common vertices.
void keepSeparateCaps(Mesh& mesh, const std::vector<Cap>& caps, std::size_t before, FilledHoles& result) {
  if (caps.empty()) return;
  const Intersections found = findIntersections(mesh, before);
  std::vector<std::vector<std::uint32_t>> touched(caps.size());  // triangles, by cap
  const auto findCap = [&](std::size_t triangle) {
    const auto next = std::upper_bound(caps.begin(), caps.end(), triangle,
                                       [](std::size_t t, const Cap& cap) { return t < cap.firstTriangle; });
    return static_cast<std::size_t>(next - caps.begin()) - 1;
  };
  for (const auto* pairs : {&found.crossing, &found.coincident})
    for (const auto& [other, triangle] : *pairs) touched[findCap(triangle)].push_back(other);
  std::vector<char> keep(caps.size(), 1);
  for (std::size_t c = 0; c < caps.size(); ++c) {
    for (const std::uint32_t other : touched[c])
      if (other < before || keep[findCap(other)] != 0) keep[c] = 0;
    if (!found.complete) keep[c] = 0;
    if (keep[c] != 0)
      result.filled.add([&] { return describeHole(mesh, *caps[c].loop, ""); });
    else
      result.left.add([&] { return describeHole(mesh, *caps[c].loop, ", the cap would cross the surface"); });
  }
  keepTriangles(mesh, [&](std::size_t i) { return i < before || keep[findCap(i)] != 0; });
}

}  // namespace

std::vector<Loop> findHoles(std::span<const EdgeUse> edges) {
  // Collect boundary edges, opposite to the direction of their triangles.
  std::unordered_multimap<std::uint32_t, std::uint32_t> next;
  std::vector<std::uint32_t> starts;
  forEachEdge(edges, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 1) return;
    const std::uint32_t from = edge[0].forward ? edge[0].high : edge[0].low;
    next.emplace(from, edge[0].forward ? edge[0].low : edge[0].high);
    starts.push_back(from);
  });

  // Follow them from the smallest vertex on.
  std::sort(starts.begin(), starts.end());
  std::vector<Loop> loops;
  for (const std::uint32_t start : starts) {
    Loop loop;
    std::uint32_t at = start;
    for (auto found = next.find(at); found != next.end(); found = next.find(at)) {
      loop.push_back(at);
      at = found->second;
      next.erase(found);
    }
    if (at == start && loop.size() > 2) loops.push_back(std::move(loop));
  }
  return loops;
}

Findings describeHoles(const Mesh& mesh, const std::vector<Loop>& loops) {
  Findings holes;
  for (const Loop& loop : loops) holes.add([&] { return describeHole(mesh, loop, ""); });
  return holes;
}

FilledHoles fillHoles(Mesh& mesh, const std::vector<Loop>& loops, std::uint64_t maxEdges) {
  if (loops.empty()) return {};

  // Find a face beside each hole, by the first vertex of the hole.
  std::unordered_map<std::uint32_t, std::size_t> beside;
  for (const Loop& loop : loops) beside.emplace(loop.front(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const auto found = beside.find(mesh.triangles[i][k]); found != beside.end()) found->second = i;

  // Collect existing edges and faces by position: a cap must not coincide with a face, nor share an inner edge with
  // one.
  const std::vector<std::uint32_t> position = positionIds(mesh);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::array<std::uint32_t, 3>> faces;
  const auto faceIds = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::array<std::uint32_t, 3> ids{position[a], position[b], position[c]};
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  for (const glm::uvec3& t : mesh.triangles) {
    faces.insert(faceIds(t.x, t.y, t.z));
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = position[t[k]], to = position[t[(k + 1) % 3]];
      edges.emplace(std::min(from, to), std::max(from, to));
    }
  }
  const auto isFree = [&](const Loop& loop, const Mesh& cap) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> inner;
    forEachEdge(edgeUses(cap.triangles), [&](std::span<const EdgeUse> edge) {
      const std::uint32_t low = position[loop[edge[0].low]], high = position[loop[edge[0].high]];
      if (edge.size() == 2) inner.emplace_back(std::min(low, high), std::max(low, high));
    });
    for (const auto& edge : inner)
      if (edges.contains(edge)) return false;
    for (const glm::uvec3& t : cap.triangles)
      if (faces.contains(faceIds(loop[t.x], loop[t.y], loop[t.z]))) return false;
    edges.insert(inner.begin(), inner.end());
    for (const glm::uvec3& t : cap.triangles) faces.insert(faceIds(loop[t.x], loop[t.y], loop[t.z]));
    return true;
  };

  // Triangulate each loop as a polygon.
  FilledHoles result;
  std::vector<Cap> caps;
  const std::size_t before = mesh.triangles.size();
  for (const Loop& loop : loops) {
    Polygons polygon;
    for (const std::uint32_t v : loop) {
      polygon.corners.push_back(static_cast<std::uint32_t>(polygon.positions.size()));
      polygon.positions.push_back(mesh.positions[v]);
    }
    polygon.closeFace();
    TriangulateCounts counts;
    Mesh cap;
    bool simple = loop.size() <= maxEdges;
    if (simple) try {
        cap = triangulate(polygon, counts);
      } catch (const Error&) {  // too complex to triangulate
        simple = false;
      }
    const bool flat = std::any_of(cap.triangles.begin(), cap.triangles.end(), [&](const glm::uvec3& t) {
      return isWithoutArea(cap.positions[t.x], cap.positions[t.y], cap.positions[t.z]);
    });
    const bool free = simple && counts.crossing == 0 && counts.repeatedCorners == 0 && !flat && isFree(loop, cap);
    if (!free) {
      result.left.add([&] { return describeHole(mesh, loop, loop.size() > maxEdges ? "" : ", cannot be filled"); });
      continue;
    }
    caps.push_back({&loop, mesh.triangles.size()});
    for (const glm::uvec3& t : cap.triangles)
      addTriangle(mesh, {loop[t.x], loop[t.y], loop[t.z]}, beside.at(loop.front()));
  }
  keepSeparateCaps(mesh, caps, before, result);
  return result;
}

}  // namespace malus::prep
