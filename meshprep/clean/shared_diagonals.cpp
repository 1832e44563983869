#include "meshprep/clean/shared_diagonals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include <tbb/parallel_sort.h>

#include "meshprep/base/parallel_blocks.h"
#include "meshprep/clean/flat_polygon.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/clean/triangulate.h"

namespace malus::prep {

namespace {

using EdgeKey = std::uint64_t;

EdgeKey makeKey(std::uint32_t a, std::uint32_t b) {
  return static_cast<EdgeKey>(std::min(a, b)) << 32u | std::max(a, b);
}

struct Diagonal {
  EdgeKey key;
  std::uint32_t face;
};

// Set of edges that may report edges that it does not contain.
class EdgeFilter {
 public:
  explicit EdgeFilter(const std::vector<Diagonal>& diagonals) : bits_(std::bit_ceil(8 * diagonals.size() + 64), false) {
    for (const Diagonal& d : diagonals) bits_[slot(d.key)] = true;
  }
  bool mayContain(EdgeKey key) const { return bits_[slot(key)]; }

 private:
  std::size_t slot(EdgeKey key) const { return (key * 0x9e3779b97f4a7c15u >> 20u) & (bits_.size() - 1); }
  std::vector<bool> bits_;
};

class Recutter {
 public:
  Recutter(const Polygons& polygons, const std::vector<std::size_t>& firstTriangle, Mesh& mesh)
      : polygons_(polygons), firstTriangle_(firstTriangle), mesh_(mesh), ids_(positionIds(mesh)) {}

  std::uint64_t run() {
    listDiagonals();
    std::vector<std::uint32_t> faces = findConflicts();
    removeDoubled(faces);
    if (faces.empty()) return 0;
    countUses(faces);
    std::uint64_t recut = 0;
    for (const std::uint32_t face : faces) recut += recutFace(face) ? 1 : 0;
    return recut;
  }

 private:
  std::size_t triangleCount(std::size_t face) const { return firstTriangle_[face + 1] - firstTriangle_[face]; }

  // Calls visit(key) for the edges between triangles of a face. edges: memory for them.
  template <class Visit>
  void forDiagonals(std::size_t face, std::vector<EdgeKey>& edges, Visit visit) const {
    edges.clear();
    for (std::size_t t = firstTriangle_[face]; t < firstTriangle_[face + 1]; ++t)
      for (int k = 0; k < 3; ++k)
        edges.push_back(makeKey(ids_[mesh_.triangles[t][k]], ids_[mesh_.triangles[t][(k + 1) % 3]]));
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 1; i < edges.size(); ++i)
      if (edges[i] == edges[i - 1]) visit(edges[i]);
  }

  void listDiagonals() {
    diagonals_ = collectBlocks<Diagonal>(
        polygons_.faceCount(), [&](std::size_t first, std::size_t last, std::vector<Diagonal>& list) {
          std::vector<EdgeKey> edges;
          for (std::size_t face = first; face < last; ++face)
            if (triangleCount(face) > 1)
              forDiagonals(face, edges, [&](EdgeKey key) { list.push_back({key, static_cast<std::uint32_t>(face)}); });
        });
    tbb::parallel_sort(diagonals_.begin(), diagonals_.end(), [](const Diagonal& a, const Diagonal& b) {
      return a.key != b.key ? a.key < b.key : a.face < b.face;
    });
  }

  // Calls visit(key) for the edges of a face of the file.
  template <class Visit>
  void forEdges(std::size_t face, Visit visit) const {
    const auto corners = polygons_.face(face);
    for (std::size_t c = 0; c < corners.size(); ++c)
      visit(makeKey(ids_[corners[c]], ids_[corners[(c + 1) % corners.size()]]));
  }

  // Returns the faces with a diagonal that is also a diagonal or an edge of another face, in their order.
  std::vector<std::uint32_t> findConflicts() const {
    const auto range = [&](EdgeKey key) {
      return std::equal_range(diagonals_.begin(), diagonals_.end(), Diagonal{key, 0},
                              [](const Diagonal& a, const Diagonal& b) { return a.key < b.key; });
    };
    std::vector<std::uint32_t> faces;
    for (std::size_t i = 1; i < diagonals_.size(); ++i)
      if (diagonals_[i].key == diagonals_[i - 1].key)
        faces.insert(faces.end(), {diagonals_[i - 1].face, diagonals_[i].face});
    const EdgeFilter filter(diagonals_);
    const std::vector<std::uint32_t> besideEdges = collectBlocks<std::uint32_t>(
        polygons_.faceCount(), [&](std::size_t first, std::size_t last, std::vector<std::uint32_t>& list) {
          for (std::size_t face = first; face < last; ++face)
            forEdges(face, [&](EdgeKey key) {
              if (!filter.mayContain(key)) return;
              for (auto [found, end] = range(key); found != end; ++found) list.push_back(found->face);
            });
        });
    faces.insert(faces.end(), besideEdges.begin(), besideEdges.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  // Removes faces with the same corners as another one, which are the two sides of a doubled surface and stay back to
  // back.
  void removeDoubled(std::vector<std::uint32_t>& faces) const {
    const auto sortedCorners = [&](std::uint32_t face) {
      std::vector<std::uint32_t> corners;
      for (const std::uint32_t corner : polygons_.face(face)) corners.push_back(ids_[corner]);
      std::sort(corners.begin(), corners.end());
      return corners;
    };
    std::map<std::vector<std::uint32_t>, std::uint32_t> counts;
    for (const std::uint32_t face : faces) ++counts[sortedCorners(face)];
    std::erase_if(faces, [&](std::uint32_t face) { return counts[sortedCorners(face)] > 1; });
  }

  // Counts the faces of every edge and diagonal between corners of these faces.
  void countUses(const std::vector<std::uint32_t>& faces) {
    std::vector<char> isCorner(mesh_.positions.size(), 0);
    for (const std::uint32_t face : faces)
      for (const std::uint32_t corner : polygons_.face(face)) isCorner[ids_[corner]] = 1;
    const auto add = [&](EdgeKey key) {
      if (isCorner[key >> 32u] != 0 && isCorner[key & 0xffffffffu] != 0) ++uses_[key];
    };
    for (std::size_t face = 0; face < polygons_.faceCount(); ++face) forEdges(face, add);
    for (const Diagonal& diagonal : diagonals_) add(diagonal.key);
  }

  std::uint32_t countUses(EdgeKey key) const {
    const auto found = uses_.find(key);
    return found == uses_.end() ? 0 : found->second;
  }

  // Cuts a face along diagonals that no other face uses, if there are fewer conflicts then.
  bool recutFace(std::uint32_t face) {
    // Find the corners without repetitions, as triangulate() uses them.
    const auto corners = polygons_.face(face);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t c = 0; c < corners.size(); ++c)
      if (kept.empty() || ids_[corners[c]] != ids_[corners[kept.back()]]) kept.push_back(c);
    while (kept.size() > 1 && ids_[corners[kept.back()]] == ids_[corners[kept.front()]]) kept.pop_back();
    if (kept.size() > kMaxRecutCorners || kept.size() != triangleCount(face) + 2) return false;

    // Count its conflicts without its own diagonals.
    std::uint32_t conflicts = 0;
    forDiagonals(face, edges_, [&](EdgeKey key) { --uses_[key]; });
    forDiagonals(face, edges_, [&](EdgeKey key) { conflicts += countUses(key) > 0 ? 1u : 0u; });
    const auto cut = conflicts > 0 ? findCut(face, kept) : std::nullopt;
    const bool better = cut && cut->first < conflicts;
    if (better)
      for (std::size_t i = 0; i < cut->second.size(); ++i)
        setTriangle(firstTriangle_[face] + i, face,
                    {kept[cut->second[i].x], kept[cut->second[i].y], kept[cut->second[i].z]});
    forDiagonals(face, edges_, [&](EdgeKey key) { ++uses_[key]; });
    return better;
  }

  // Returns the smallest number of conflicts of a triangulation, and its triangles. In the plane of the face all
  // triangles are counter-clockwise; as the sum of their areas is that of the polygon, they cover it once. Dynamic
  // programming over the parts of the boundary from corner i to corner j; source: G. T. Klincsek, "Minimal
  // triangulations of polygonal domains", Annals of Discrete Mathematics 9, 1980.
  std::optional<std::pair<std::uint32_t, std::vector<glm::uvec3>>> findCut(
      std::uint32_t face, const std::vector<std::uint32_t>& kept) const {
    constexpr std::uint32_t kImpossible = 1u << 30u;
    const auto n = static_cast<std::uint32_t>(kept.size());
    const auto corners = polygons_.face(face);
    std::vector<glm::dvec3> points;
    points.reserve(kept.size());
    for (const std::uint32_t c : kept) points.push_back(polygons_.positions[corners[c]]);
    const FlatPolygon flat = flatten(points);
    const auto conflict = [&](std::uint32_t i, std::uint32_t j) {
      if (j == i + 1 || (i == 0 && j == n - 1)) return 0u;
      return countUses(makeKey(ids_[corners[kept[i]]], ids_[corners[kept[j]]])) > 0 ? 1u : 0u;
    };
    std::vector<std::uint32_t> cost(std::size_t{n} * n, 0), apex(std::size_t{n} * n, 0);
    for (std::uint32_t length = 2; length < n; ++length)
      for (std::uint32_t i = 0; i + length < n; ++i) {
        const std::uint32_t j = i + length;
        std::uint32_t& best = cost[i * n + j] = kImpossible;
        for (std::uint32_t k = i + 1; k < j; ++k) {
          if (!hasArea(flat, i, k, j)) continue;
          const std::uint32_t sum = cost[i * n + k] + cost[k * n + j] + conflict(i, k) + conflict(k, j);
          if (sum >= best) continue;
          best = sum;
          apex[i * n + j] = k;
        }
      }
    if (cost[n - 1] >= kImpossible) return std::nullopt;
    std::vector<glm::uvec3> triangles;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> parts = {{0, n - 1}};
    while (!parts.empty()) {
      const auto [i, j] = parts.back();
      parts.pop_back();
      if (j == i + 1) continue;
      const std::uint32_t k = apex[i * n + j];
      triangles.emplace_back(i, k, j);
      parts.emplace_back(k, j);
      parts.emplace_back(i, k);
    }
    return std::pair(cost[n - 1], triangles);
  }

  void setTriangle(std::size_t triangle, std::size_t face, const std::array<std::uint32_t, 3>& corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t corner = polygons_.firstCorner[face] + corners[k];
      const std::uint32_t vertex = polygons_.corners[corner];
      mesh_.triangles[triangle][static_cast<int>(k)] = vertex;
      if (!polygons_.cornerNormals.empty())
        mesh_.cornerNormals[3 * triangle + k] = polygons_.cornerNormals[corner];
      else if (!polygons_.normals.empty())
        mesh_.cornerNormals[3 * triangle + k] = polygons_.normals[vertex];
      if (!mesh_.cornerTextures.empty()) mesh_.cornerTextures[3 * triangle + k] = cornerTexture(polygons_, corner);
    }
  }

  const Polygons& polygons_;
  const std::vector<std::size_t>& firstTriangle_;
  Mesh& mesh_;
  std::vector<std::uint32_t> ids_;
  std::vector<Diagonal> diagonals_;  // by key, then by face
  std::unordered_map<EdgeKey, std::uint32_t> uses_;
  std::vector<EdgeKey> edges_;  // of the current face
};

}  // namespace

std::uint64_t recutSharedDiagonals(const Polygons& polygons, const std::vector<std::size_t>& firstTriangle,
                                   Mesh& mesh) {
  if (mesh.triangles.size() == polygons.faceCount() && firstTriangle.back() == polygons.faceCount()) return 0;
  return Recutter(polygons, firstTriangle, mesh).run();
}

}  // namespace malus::prep
