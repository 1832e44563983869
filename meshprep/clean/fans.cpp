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
#include "meshprep/clean/edges.h"
#include "meshprep/clean/pieces.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

// A surface has one fan a vertex. Where there are very many more, faces join vertices at random.
constexpr std::size_t kFansPerVertex = 4;
constexpr std::size_t kFansOfAnyMesh = 65536;
constexpr double kSameAngle = 1e-9;  // radians: triangles that lie on each other

// Two triangles that stay together on an edge, or one alone.
struct Pair {
  EdgeUse first, second;
  bool single = false;
};

std::uint32_t beginCorner(const EdgeUse& use) { return 3 * use.triangle + use.corner; }
std::uint32_t endCorner(const EdgeUse& use) { return 3 * use.triangle + (use.corner + 1u) % 3; }

// The corner at the edge's lower vertex, and at the higher.
std::uint32_t lowCorner(const EdgeUse& use) { return use.forward ? beginCorner(use) : endCorner(use); }
std::uint32_t highCorner(const EdgeUse& use) { return use.forward ? endCorner(use) : beginCorner(use); }

class Splitter {
 public:
  Splitter(Mesh& mesh, std::string_view where) : mesh_(mesh), where_(where) {}

  Fans run() {
    pairUp();
    splitVertices();
    cutCrowdedEdges();
    return std::move(fans_);
  }

 private:
  // What hangs together through edges of two triangles, as the first triangle of each part.
  void findParts(std::span<const EdgeUse> uses) {
    Pieces parts(mesh_.triangles.size());
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2 && !backToBack(edge[0], edge[1])) parts.merge(edge[0].triangle, edge[1].triangle);
    });
    partOf_.resize(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < partOf_.size(); ++t) partOf_[t] = parts.find(t);
  }

  // Where a triangle lies around the edge, as an angle from the first one, in [0, 2 pi).
  std::vector<double> anglesAround(std::span<const EdgeUse> edge) const {
    const glm::dvec3 low = mesh_.positions[edge[0].low];
    const glm::dvec3 along = glm::normalize(mesh_.positions[edge[0].high] - low);
    std::vector<glm::dvec3> out;
    for (const EdgeUse& use : edge) {
      const glm::dvec3 apex = mesh_.positions[apexOf(use)] - low;
      out.push_back(glm::normalize(apex - glm::dot(apex, along) * along));
    }
    const glm::dvec3 x = out[0], y = glm::cross(along, x);
    std::vector<double> angles;
    for (const glm::dvec3& o : out) {
      double angle = std::atan2(glm::dot(o, y), glm::dot(o, x));
      if (angle < -kSameAngle) angle += 2 * std::numbers::pi;
      angles.push_back(std::max(angle, 0.0));
    }
    return angles;
  }

  // Pairs those among `candidates` (indices into edge, by angle) whose backs face each other. A triangle that runs from
  // low to high has its back toward smaller angles: it closes a bracket that the other kind opens.
  // matched: one an index, set for those paired.
  static void matchBrackets(std::span<const EdgeUse> edge, std::span<const std::size_t> candidates,
                            std::vector<char>& matched, std::vector<Pair>& pairs) {
    std::vector<std::size_t> open;
    for (int turn = 0; turn < 2; ++turn)  // twice around: the first bracket may close one that opens last
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

  std::vector<Pair> pairsOf(std::span<const EdgeUse> edge) const {
    // Step 1: in the order around the edge; of those at the same angle, first what closes, and inside of the others
    // the one of the smallest apex: so the halves of a cut edge, whichever way they run, are paired as each other.
    std::vector<double> angles = anglesAround(edge);
    std::vector<std::size_t> order(edge.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return angles[a] != angles[b] ? angles[a] < angles[b] : a < b; });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (angles[order[i]] - angles[order[i - 1]] <= kSameAngle) angles[order[i]] = angles[order[i - 1]];
    const auto inner = [&](std::size_t a, std::size_t b) {
      const glm::dvec3 &p = mesh_.positions[apexOf(edge[a])], &q = mesh_.positions[apexOf(edge[b])];
      return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (angles[a] != angles[b]) return angles[a] < angles[b];
      if (edge[a].forward != edge[b].forward) return edge[a].forward;
      return edge[a].forward ? inner(a, b) : inner(b, a);
    });

    // Step 2: first within a part, then among all that are left.
    std::vector<Pair> pairs;
    std::vector<char> matched(edge.size(), 0);
    std::vector<std::size_t> byPart = order;
    const auto partOf = [&](std::size_t i) { return partOf_[edge[i].triangle]; };
    std::stable_sort(byPart.begin(), byPart.end(), [&](std::size_t a, std::size_t b) { return partOf(a) < partOf(b); });
    for (std::size_t begin = 0, end = 0; begin < byPart.size(); begin = end) {
      while (end < byPart.size() && partOf(byPart[end]) == partOf(byPart[begin])) ++end;
      matchBrackets(edge, std::span(byPart).subspan(begin, end - begin), matched, pairs);
    }
    std::vector<std::size_t> rest = order;
    std::erase_if(rest, [&](std::size_t i) { return matched[i] != 0; });
    matchBrackets(edge, rest, matched, pairs);
    std::erase_if(rest, [&](std::size_t i) { return matched[i] != 0; });
    for (const std::size_t i : rest) pairs.push_back({edge[i], {}, true});
    return pairs;
  }

  // The two sides of a wall without thickness are two sheets, not a fold.
  bool backToBack(const EdgeUse& a, const EdgeUse& b) const { return a.forward != b.forward && apexOf(a) == apexOf(b); }
  std::uint32_t apexOf(const EdgeUse& use) const { return mesh_.triangles[use.triangle][(use.corner + 2) % 3]; }

  void pairUp() {
    const std::vector<EdgeUse> uses = edgeUses(mesh_.triangles);
    bool crowded = false;
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) { crowded = crowded || edge.size() > 2; });
    if (crowded) findParts(uses);
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 1) return;
      if (edge.size() == 2) {
        if (!backToBack(edge[0], edge[1])) pairs_.push_back({edge[0], edge[1], false});
        return;
      }
      fans_.edges.add([&] {
        return findingAt(mesh_, (mesh_.positions[edge[0].low] + mesh_.positions[edge[0].high]) * 0.5,
                         {edge[0].triangle, edge[1].triangle, edge[2].triangle}, {edge[0].low, edge[0].high});
      });
      const std::vector<Pair> pairs = pairsOf(edge);
      pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
    });
  }

  void splitVertices() {
    // Step 1: fans.
    const auto cornerCount = static_cast<std::uint32_t>(3 * mesh_.triangles.size());
    Pieces fans(cornerCount);
    for (const Pair& pair : pairs_) {
      if (pair.single) continue;
      fans.merge(lowCorner(pair.first), lowCorner(pair.second));
      fans.merge(highCorner(pair.first), highCorner(pair.second));
    }
    const auto vertexAt = [&](std::uint32_t corner) {
      return mesh_.triangles[corner / 3][static_cast<int>(corner % 3)];
    };
    std::vector<std::uint32_t> fansOf(mesh_.positions.size(), 0);
    std::size_t fanCount = 0;
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner) {
      if (fans.find(corner) != corner) continue;
      ++fansOf[vertexAt(corner)];
      ++fanCount;
    }
    const std::size_t most = kFansOfAnyMesh + kFansPerVertex * mesh_.positions.size();
    if (fanCount > most)
      throw Error(where_, "the faces form no surface",
                  fmt::format("at most {} fans around {} vertices", most, mesh_.positions.size()),
                  fmt::to_string(fanCount));
    for (std::size_t v = 0; v < fansOf.size(); ++v)
      if (fansOf[v] > 1) fans_.vertices.add([&] { return findingAt(mesh_, mesh_.positions[v], {}, {v}); });
    if (fans_.vertices.count == 0) return;

    // Step 2: the vertex of the file that each fan of a split vertex names, the smallest of its corners.
    std::vector<std::uint32_t> nameOf(cornerCount, kNoSource);
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner) {
      if (fansOf[vertexAt(corner)] < 2) continue;
      const std::uint32_t name = mesh_.sourceCorners.empty()
                                     ? sourceVertex(mesh_, vertexAt(corner))
                                     : mesh_.sourceCorners[corner / 3][static_cast<int>(corner % 3)];
      std::uint32_t& smallest = nameOf[fans.find(corner)];
      smallest = std::min(smallest, name);
    }

    // Step 3: vertices in the order of the file, the fans of one vertex by their first corners.
    struct NewVertex {
      std::uint32_t name, old, firstCorner;
    };
    std::vector<NewVertex> vertices;
    for (std::uint32_t v = 0; v < fansOf.size(); ++v)
      if (fansOf[v] < 2) vertices.push_back({sourceVertex(mesh_, v), v, kNoSource});
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner)
      if (fansOf[vertexAt(corner)] > 1 && fans.find(corner) == corner)
        vertices.push_back({nameOf[corner], vertexAt(corner), corner});
    std::stable_sort(vertices.begin(), vertices.end(), [](const NewVertex& a, const NewVertex& b) {
      return std::tie(a.name, a.old, a.firstCorner) < std::tie(b.name, b.old, b.firstCorner);
    });

    // Step 4: put them in.
    std::vector<std::uint32_t> from, indexOf(mesh_.positions.size(), 0), indexOfFan(cornerCount, 0);
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
      from.push_back(vertices[i].old);
      (vertices[i].firstCorner == kNoSource ? indexOf[vertices[i].old] : indexOfFan[vertices[i].firstCorner]) = i;
    }
    std::vector<glm::uvec3> triangles = mesh_.triangles;
    for (std::uint32_t corner = 0; corner < cornerCount; ++corner)
      triangles[corner / 3][static_cast<int>(corner % 3)] =
          fansOf[vertexAt(corner)] > 1 ? indexOfFan[fans.find(corner)] : indexOf[vertexAt(corner)];
    mesh_.normals.clear();
    takeVertices(mesh_, from, indexOf);
    mesh_.triangles = std::move(triangles);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (!mesh_.sourceVertices.empty()) mesh_.sourceVertices[i] = vertices[i].name;
  }

  // The triangle becomes two at vertex m of its edge; the second half goes to the end.
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
  }

  void cutCrowdedEdges() {
    // Cutting an edge changes its triangles, so the next crowded edge is looked for anew; there are hardly ever any.
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
        if (!std::exchange(known, true)) findParts(uses);
        ++fans_.cutEdges;
        for (const EdgeUse& use : edge) touched[use.triangle] = 1;
        for (const Pair& pair : pairsOf(edge)) {
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
  std::vector<std::uint32_t> partOf_;
  std::vector<Pair> pairs_;
  Fans fans_;
};

}  // namespace

Fans splitFans(Mesh& mesh, std::string_view where) { return Splitter(mesh, where).run(); }

}  // namespace malus::prep
