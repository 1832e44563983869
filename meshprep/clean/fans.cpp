#include "meshprep/clean/fans.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/disjoint_sets.h"
#include "meshprep/clean/edges.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

// A surface has one fan per vertex; many more mean random faces.
constexpr std::size_t kFansPerVertex = 4;
constexpr std::size_t kMinFanLimit = 65536;
constexpr double kSameAngle = 1e-9;  // radians: angle between coincident triangles

// Two triangles that stay connected at an edge, or a single one.
struct Pair {
  EdgeUse first, second;
  bool single = false;
};

std::uint32_t beginCorner(const EdgeUse& use) { return 3 * use.triangle + use.corner; }
std::uint32_t endCorner(const EdgeUse& use) { return 3 * use.triangle + (use.corner + 1u) % 3; }

// Corners (3 * triangle + corner) at the lower and the higher vertex of the edge.
std::uint32_t lowCorner(const EdgeUse& use) { return use.forward ? beginCorner(use) : endCorner(use); }
std::uint32_t highCorner(const EdgeUse& use) { return use.forward ? endCorner(use) : beginCorner(use); }

class Splitter {
 public:
  Splitter(Mesh& mesh, std::string_view where) : mesh_(mesh), where_(where), connected_(3 * mesh.triangles.size()) {}

  Fans run(std::span<const EdgeUse> edges) {
    const bool isManifold = connectFans(edges);
    splitVertices();
    if (!isManifold) cutNonManifoldEdges();
    return std::move(fans_);
  }

 private:
  // Finds the components that are connected through edges of two triangles, by their first triangle.
  void findComponents(std::span<const EdgeUse> uses) {
    DisjointSets parts(mesh_.triangles.size());
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2 && !areBackToBack(edge[0], edge[1])) parts.merge(edge[0].triangle, edge[1].triangle);
    });
    component_.resize(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < component_.size(); ++t) component_[t] = parts.find(t);
  }

  // Returns the angle of each triangle around the edge from the first one, in [0, 2 pi).
  std::vector<double> anglesAround(std::span<const EdgeUse> edge) const {
    const glm::dvec3 low = mesh_.positions[edge[0].low];
    const glm::dvec3 axis = glm::normalize(mesh_.positions[edge[0].high] - low);
    std::vector<glm::dvec3> out;
    for (const EdgeUse& use : edge) {
      const glm::dvec3 toApex = mesh_.positions[apex(use)] - low;
      out.push_back(glm::normalize(toApex - glm::dot(toApex, axis) * axis));
    }
    const glm::dvec3 x = out[0], y = glm::cross(axis, x);
    std::vector<double> angles;
    for (const glm::dvec3& o : out) {
      double angle = std::atan2(glm::dot(o, y), glm::dot(o, x));
      if (angle < -kSameAngle) angle += 2 * std::numbers::pi;
      angles.push_back(std::max(angle, 0.0));
    }
    return angles;
  }

  // Pairs `candidates` (indices into edge, by angle) whose backs face each other. A triangle that traverses the edge
  // from low to high has its back toward smaller angles: it closes a bracket that the other kind opens. Sets matched[i]
  // for paired ones.
  static void matchBrackets(std::span<const EdgeUse> edge, std::span<const std::size_t> candidates,
                            std::vector<char>& matched, std::vector<Pair>& pairs) {
    std::vector<std::size_t> open;
    for (int turn = 0; turn < 2; ++turn)  // two turns: the first bracket may close the last one
      for (const std::size_t i : candidates) {
        if (matched[i] != 0) continue;
        if (!edge[i].forward) {
          if (turn == 0) open.push_back(i);
        } else if (!open.empty()) {
          pairs.push_back({edge[open.back()], edge[i], false});
          matched[i] = matched[open.back()] = 1;
          open.pop_back();
        }
      }
  }

  std::vector<Pair> pairUses(std::span<const EdgeUse> edge) const {
    // Sort by angle. At equal angles, closing triangles come first, and others are nested by their apex, so that the
    // halves of a cut edge are paired consistently in both directions.
    std::vector<double> angles = anglesAround(edge);
    std::vector<std::size_t> order(edge.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return angles[a] != angles[b] ? angles[a] < angles[b] : a < b; });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (angles[order[i]] - angles[order[i - 1]] <= kSameAngle) angles[order[i]] = angles[order[i - 1]];
    const auto inner = [&](std::size_t a, std::size_t b) {
      const glm::dvec3 &p = mesh_.positions[apex(edge[a])], &q = mesh_.positions[apex(edge[b])];
      return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (angles[a] != angles[b]) return angles[a] < angles[b];
      if (edge[a].forward != edge[b].forward) return edge[a].forward;
      return edge[a].forward ? inner(a, b) : inner(b, a);
    });

    // Pair within components, then among the rest.
    std::vector<Pair> pairs;
    std::vector<char> matched(edge.size(), 0);
    std::vector<std::size_t> byComponent = order;
    const auto component = [&](std::size_t i) { return component_[edge[i].triangle]; };
    std::stable_sort(byComponent.begin(), byComponent.end(),
                     [&](std::size_t a, std::size_t b) { return component(a) < component(b); });
    for (std::size_t begin = 0, end = 0; begin < byComponent.size(); begin = end) {
      while (end < byComponent.size() && component(byComponent[end]) == component(byComponent[begin])) ++end;
      matchBrackets(edge, std::span(byComponent).subspan(begin, end - begin), matched, pairs);
    }
    std::vector<std::size_t> rest = order;
    std::erase_if(rest, [&](std::size_t i) { return matched[i] != 0; });
    matchBrackets(edge, rest, matched, pairs);
    std::erase_if(rest, [&](std::size_t i) { return matched[i] != 0; });
    for (const std::size_t i : rest) pairs.push_back({edge[i], {}, true});
    return pairs;
  }

  // Returns true for the two sides of a wall without thickness, which are not connected.
  bool areBackToBack(const EdgeUse& a, const EdgeUse& b) const { return a.forward != b.forward && apex(a) == apex(b); }
  std::uint32_t apex(const EdgeUse& use) const { return mesh_.triangles[use.triangle][(use.corner + 2) % 3]; }

  // Connects the corners of two triangles at both ends of their edge.
  void connect(const EdgeUse& a, const EdgeUse& b) {
    connected_.merge(lowCorner(a), lowCorner(b));
    connected_.merge(highCorner(a), highCorner(b));
  }

  // Connects the corners of each fan. Returns false if an edge has more than two triangles.
  bool connectFans(std::span<const EdgeUse> edges) {
    bool isManifold = true;
    forEachEdge(edges, [&](std::span<const EdgeUse> edge) { isManifold = isManifold && edge.size() <= 2; });
    if (!isManifold) findComponents(edges);
    forEachEdge(edges, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 1) return;
      if (edge.size() == 2) {
        if (!areBackToBack(edge[0], edge[1])) connect(edge[0], edge[1]);
        return;
      }
      fans_.edges.add([&] {
        return findingAt(mesh_, (mesh_.positions[edge[0].low] + mesh_.positions[edge[0].high]) * 0.5,
                         {edge[0].triangle, edge[1].triangle, edge[2].triangle}, {edge[0].low, edge[0].high});
      });
      for (const Pair& pair : pairUses(edge))
        if (!pair.single) connect(pair.first, pair.second);
    });
    return isManifold;
  }

  void splitVertices() {
    // Count the fans.
    const auto cornerCount = static_cast<std::uint32_t>(3 * mesh_.triangles.size());
    const auto vertexAt = [&](std::uint32_t corner) {
      return mesh_.triangles[corner / 3][static_cast<int>(corner % 3)];
    };
    std::vector<std::uint32_t> fanCounts(mesh_.positions.size(), 0);
    std::size_t fanCount = 0;
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner) {
      if (connected_.find(corner) != corner) continue;
      ++fanCounts[vertexAt(corner)];
      ++fanCount;
    }
    const std::size_t most = kMinFanLimit + kFansPerVertex * mesh_.positions.size();
    if (fanCount > most)
      throw Error(where_, "faces do not form a surface",
                  fmt::format("at most {} fans around {} vertices", most, mesh_.positions.size()),
                  fmt::to_string(fanCount));
    for (std::size_t v = 0; v < fanCounts.size(); ++v)
      if (fanCounts[v] > 1) fans_.vertices.add([&] { return findingAt(mesh_, mesh_.positions[v], {}, {v}); });
    if (fans_.vertices.count == 0) return;

    // Find the smallest source vertex of each fan of a split vertex.
    std::vector<std::uint32_t> sourceByFan(cornerCount, kNoSource);
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner) {
      if (fanCounts[vertexAt(corner)] < 2) continue;
      const std::uint32_t name = mesh_.sourceCorners.empty()
                                     ? sourceVertex(mesh_, vertexAt(corner))
                                     : mesh_.sourceCorners[corner / 3][static_cast<int>(corner % 3)];
      std::uint32_t& smallest = sourceByFan[connected_.find(corner)];
      smallest = std::min(smallest, name);
    }

    // Order vertices by the file, and the fans of a vertex by their first corners.
    struct NewVertex {
      std::uint32_t name, old, firstCorner;
    };
    std::vector<NewVertex> vertices;
    for (std::uint32_t v = 0; v < fanCounts.size(); ++v)
      if (fanCounts[v] < 2) vertices.push_back({sourceVertex(mesh_, v), v, kNoSource});
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner)
      if (fanCounts[vertexAt(corner)] > 1 && connected_.find(corner) == corner)
        vertices.push_back({sourceByFan[corner], vertexAt(corner), corner});
    std::stable_sort(vertices.begin(), vertices.end(), [](const NewVertex& a, const NewVertex& b) {
      return std::tie(a.name, a.old, a.firstCorner) < std::tie(b.name, b.old, b.firstCorner);
    });

    // Replace the vertices.
    std::vector<std::uint32_t> from, newIndex(mesh_.positions.size(), 0), fanIndex(cornerCount, 0);
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
      from.push_back(vertices[i].old);
      (vertices[i].firstCorner == kNoSource ? newIndex[vertices[i].old] : fanIndex[vertices[i].firstCorner]) = i;
    }
    std::vector<glm::uvec3> triangles = mesh_.triangles;
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner)
      triangles[corner / 3][static_cast<int>(corner % 3)] =
          fanCounts[vertexAt(corner)] > 1 ? fanIndex[connected_.find(corner)] : newIndex[vertexAt(corner)];
    mesh_.normals.clear();
    selectVertices(mesh_, from, newIndex);
    mesh_.triangles = std::move(triangles);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (!mesh_.sourceVertices.empty()) mesh_.sourceVertices[i] = vertices[i].name;
  }

  // Cuts a triangle in two at vertex m of its edge. The second half is appended.
  void cutTriangle(const EdgeUse& use, std::uint32_t m) {
    const glm::uvec3 t = mesh_.triangles[use.triangle];
    const std::uint32_t to = t[(use.corner + 1) % 3], apex = t[(use.corner + 2) % 3];
    const glm::uvec3 corners = mesh_.sourceCorners.empty() ? t : mesh_.sourceCorners[use.triangle];
    const glm::vec3 toNormal =
        mesh_.cornerNormals.empty() ? glm::vec3(0) : mesh_.cornerNormals[3 * use.triangle + (use.corner + 1u) % 3];
    mesh_.triangles[use.triangle][(use.corner + 1) % 3] = m;
    if (!mesh_.sourceCorners.empty()) mesh_.sourceCorners[use.triangle][(use.corner + 1) % 3] = kNoSource;
    if (!mesh_.cornerNormals.empty()) mesh_.cornerNormals[3 * use.triangle + (use.corner + 1u) % 3] = glm::vec3(0);
    const std::size_t half = mesh_.triangles.size();
    addTriangle(mesh_, {m, to, apex}, use.triangle);
    const std::size_t toCorner = (use.corner + 1u) % 3, apexCorner = (use.corner + 2u) % 3;
    if (!mesh_.sourceCorners.empty())
      mesh_.sourceCorners[half] = {kNoSource, corners[static_cast<int>(toCorner)],
                                   corners[static_cast<int>(apexCorner)]};
    if (!mesh_.cornerNormals.empty()) {
      mesh_.cornerNormals[3 * half + 1] = toNormal;
      mesh_.cornerNormals[3 * half + 2] = mesh_.cornerNormals[3 * use.triangle + apexCorner];
    }
    cutTexture(use.triangle, use.corner, half);
  }

  // Sets the texture attributes of the halves of a triangle that is cut in the middle of its edge from a corner on.
  void cutTexture(std::size_t triangle, std::size_t corner, std::size_t half) {
    if (mesh_.cornerTextures.empty()) return;
    const auto at = [&](std::size_t i) -> CornerTexture& { return mesh_.cornerTextures[3 * triangle + i % 3]; };
    const CornerTexture middle = interpolated(at(corner), at(corner + 1), 0.5), to = at(corner + 1),
                        apex = at(corner + 2);
    at(corner + 1) = middle;
    mesh_.cornerTextures[3 * half] = middle;
    mesh_.cornerTextures[3 * half + 1] = to;
    mesh_.cornerTextures[3 * half + 2] = apex;
  }

  void cutNonManifoldEdges() {
    // Search again after each cut, because it changes triangles. Such edges are rare.
    for (bool again = true; again;) {
      again = false;
      const std::vector<EdgeUse> uses = edgeUses(mesh_.triangles);
      std::vector<char> touched(mesh_.triangles.size(), 0);
      bool known = false;
      forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() < 3) return;
        if (std::any_of(edge.begin(), edge.end(), [&](const EdgeUse& use) { return touched[use.triangle] != 0; })) {
          again = true;
          return;
        }
        if (!std::exchange(known, true)) findComponents(uses);
        ++fans_.cutEdges;
        for (const EdgeUse& use : edge) touched[use.triangle] = 1;
        for (const Pair& pair : pairUses(edge)) {
          const auto m = static_cast<std::uint32_t>(mesh_.positions.size());
          mesh_.positions.push_back((mesh_.positions[edge[0].low] + mesh_.positions[edge[0].high]) * 0.5);
          if (!mesh_.sourceVertices.empty()) mesh_.sourceVertices.push_back(kNoSource);
          mesh_.normals.clear();
          cutTriangle(pair.first, m);
          if (!pair.single) cutTriangle(pair.second, m);
        }
      });
    }
  }

  Mesh& mesh_;
  std::string_view where_;
  std::vector<std::uint32_t> component_;
  DisjointSets connected_;  // corners of each fan
  Fans fans_;
};

}  // namespace

Fans splitFans(Mesh& mesh, std::span<const EdgeUse> edges, std::string_view where) {
  return Splitter(mesh, where).run(edges);
}

}  // namespace malus::prep
