#include "meshprep/clean/duplicate_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "meshprep/base/bucket_sort.h"
#include "meshprep/clean/disjoint_sets.h"
#include "meshprep/clean/edges.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

// Triangle with sorted vertices.
struct Face {
  std::uint32_t low = 0, middle = 0, high = 0;
  std::uint32_t triangle = 0;
  bool even = false;  // orientation: low, middle, high

  bool hasSameVertices(const Face& other) const {
    return low == other.low && middle == other.middle && high == other.high;
  }
};

Face makeFace(const glm::uvec3& t, std::uint32_t triangle) {
  Face face{std::min({t.x, t.y, t.z}), 0, std::max({t.x, t.y, t.z}), triangle, false};
  face.middle = std::max(std::min(t.x, t.y), std::min(std::max(t.x, t.y), t.z));
  face.even = (t.x == face.low && t.y == face.middle) || (t.y == face.low && t.z == face.middle) ||
              (t.z == face.low && t.x == face.middle);
  return face;
}

// Returns the faces by their vertices, then by triangle.
std::vector<Face> sortedFaces(const Mesh& mesh) {
  const auto forEach = [&](auto visit) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const Face face = makeFace(mesh.triangles[i], i);
      visit(face.low, face);
    }
  };
  return sortInBuckets<Face>(mesh.positions.size(), forEach,
                             [](const Face& a, const Face& b) {
                               return std::tie(a.middle, a.high, a.triangle) < std::tie(b.middle, b.high, b.triangle);
                             })
      .items;
}

constexpr std::uint32_t kNone = kNoSource;

// The pairs of faces with equal vertices and orientation that could be a wall, and the edges of the pairs.
class Walls {
 public:
  Walls(const Mesh& mesh, std::vector<std::array<std::uint32_t, 2>> pairs)
      : mesh_(mesh), pairs_(std::move(pairs)), patches_(pairs_.size()) {}

  // Returns the later triangles of the pairs that are walls. dropped: not kNone for triangles that will be dropped.
  std::vector<std::uint32_t> find(const std::vector<std::uint32_t>& dropped) {
    std::vector<std::uint32_t> walls;
    if (pairs_.empty()) return walls;
    collectEdges(dropped);

    // Connect the pairs, and test the border edges of each connected patch.
    for (const auto& [key, edge] : edges_)
      for (std::size_t i = 1; i < edge.pairs.size(); ++i) patches_.merge(edge.pairs[0], edge.pairs[i]);
    std::vector<char> hasBorder(pairs_.size(), 0), isLoose(pairs_.size(), 0);
    for (const auto& [key, edge] : edges_) {
      if (edge.pairs.size() != 1) continue;
      const std::uint32_t patch = patches_.find(edge.pairs[0]);
      hasBorder[patch] = 1;
      if (edge.others != 2 || (edge.agreeing != 2 && shareSources(pairs_[edge.pairs[0]]))) isLoose[patch] = 1;
    }
    requireClosedBodies(dropped, isLoose);
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
      const std::uint32_t patch = patches_.find(i);
      if (hasBorder[patch] != 0 && isLoose[patch] == 0) walls.push_back(pairs_[i][1]);
    }
    return walls;
  }

 private:
  struct Edge {
    std::vector<std::uint32_t> pairs;
    bool isForward = false;      // the first pair traverses it from the smaller vertex
    std::uint32_t others = 0;    // other triangles
    std::uint32_t agreeing = 0;  // those that traverse it in the opposite direction of the pair
  };

  static std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32u | std::max(a, b);
  }

  // Marks the patches with pairs that share vertices of the file, unless the faces that are connected with them through
  // edges form closed surfaces: an even number of faces at each edge.
  void requireClosedBodies(const std::vector<std::uint32_t>& dropped, std::vector<char>& isLoose) {
    std::vector<std::uint32_t> shared;  // pairs
    for (std::uint32_t i = 0; i < pairs_.size(); ++i)
      if (isLoose[patches_.find(i)] == 0 && shareSources(pairs_[i])) shared.push_back(i);
    if (shared.empty()) return;
    std::vector<char> isPaired(mesh_.triangles.size(), 0);
    for (const auto& pair : pairs_) isPaired[pair[0]] = isPaired[pair[1]] = 1;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> number(mesh_.triangles.size(), kNone);  // kNone: without area
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const glm::uvec3& t = mesh_.triangles[i];
      if ((dropped[i] != kNone && isPaired[i] == 0) || t.x == t.y || t.y == t.z || t.z == t.x) continue;
      number[i] = static_cast<std::uint32_t>(triangles.size());
      triangles.push_back(t);
    }
    DisjointSets bodies(triangles.size());
    std::vector<std::uint32_t> openAt;  // triangles
    forEachEdge(edgeUses(triangles), [&](std::span<const EdgeUse> edge) {
      for (std::size_t i = 1; i < edge.size(); ++i) bodies.merge(edge[0].triangle, edge[i].triangle);
      if (edge.size() % 2 != 0) openAt.push_back(edge[0].triangle);
    });
    std::vector<char> isOpen(triangles.size(), 0);
    for (const std::uint32_t triangle : openAt) isOpen[bodies.find(triangle)] = 1;
    for (const std::uint32_t i : shared) {
      const std::uint32_t triangle = number[pairs_[i][0]];
      if (triangle == kNone || isOpen[bodies.find(triangle)] != 0) isLoose[patches_.find(i)] = 1;
    }
  }

  // Returns true if a vertex of the file is a corner of both triangles.
  bool shareSources(const std::array<std::uint32_t, 2>& pair) const {
    if (mesh_.sourceCorners.empty()) return false;
    const glm::uvec3 &a = mesh_.sourceCorners[pair[0]], &b = mesh_.sourceCorners[pair[1]];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (a[i] == b[j]) return true;
    return false;
  }

  void collectEdges(const std::vector<std::uint32_t>& dropped) {
    std::vector<char> isPaired(mesh_.triangles.size(), 0);
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
      for (const std::uint32_t triangle : pairs_[i]) isPaired[triangle] = 1;
      const glm::uvec3& t = mesh_.triangles[pairs_[i][0]];
      for (int k = 0; k < 3; ++k) {
        Edge& edge = edges_[edgeKey(t[k], t[(k + 1) % 3])];
        if (edge.pairs.empty()) edge.isForward = t[k] < t[(k + 1) % 3];
        edge.pairs.push_back(i);
      }
    }
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (isPaired[i] != 0 || dropped[i] != kNone) continue;
      const glm::uvec3& t = mesh_.triangles[i];
      for (int k = 0; k < 3; ++k)
        if (const auto found = edges_.find(edgeKey(t[k], t[(k + 1) % 3])); found != edges_.end()) {
          ++found->second.others;
          if ((t[k] < t[(k + 1) % 3]) != found->second.isForward) ++found->second.agreeing;
        }
    }
  }

  const Mesh& mesh_;
  std::vector<std::array<std::uint32_t, 2>> pairs_;
  DisjointSets patches_;
  std::unordered_map<std::uint64_t, Edge> edges_;
};

}  // namespace

DuplicateFaces dropDuplicateFaces(Mesh& mesh, bool dropOpposite) {
  // Find the first triangle with the same vertices, for each orientation.
  const std::vector<Face> faces = sortedFaces(mesh);
  std::vector<std::uint32_t> same(mesh.triangles.size(), kNone), opposite(mesh.triangles.size(), kNone);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    std::array<std::uint32_t, 2> first{kNone, kNone};  // per orientation
    for (; end < faces.size() && faces[end].hasSameVertices(faces[begin]); ++end) {
      const Face& face = faces[end];
      std::uint32_t& earlier = first[face.even ? 1 : 0];
      if (earlier != kNone) {
        same[face.triangle] = earlier;
      } else {
        earlier = face.triangle;
        opposite[face.triangle] = first[face.even ? 0 : 1];
      }
    }
    if (end - begin == 2 && same[faces[begin + 1].triangle] != kNone)
      pairs.push_back({faces[begin].triangle, faces[begin + 1].triangle});
  }
  std::vector<char> isWall(mesh.triangles.size(), 0);
  for (const std::uint32_t triangle : Walls(mesh, std::move(pairs)).find(same)) isWall[triangle] = 1;

  // Drop and report in the order of the mesh.
  DuplicateFaces result;
  std::vector<char> keep(mesh.triangles.size(), 1);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (isWall[i] != 0) {
      result.walls.add([&] { return findingAt(mesh, centroid(mesh, i), {i, same[i]}); });
    } else if (same[i] != kNone) {
      result.same.add([&] { return findingAt(mesh, centroid(mesh, i), {i, same[i]}); });
      keep[i] = 0;
    } else if (opposite[i] != kNone) {
      result.opposite.add([&] { return findingAt(mesh, centroid(mesh, i), {i, opposite[i]}); });
      keep[i] = dropOpposite ? 0 : 1;
    }
  }
  keepTriangles(mesh, [&](std::size_t i) { return keep[i] != 0; });
  return result;
}

}  // namespace malus::prep
