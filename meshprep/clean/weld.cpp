#include "meshprep/clean/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/degenerate_faces.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

constexpr double kMaxCell = 9007199254740992.0;  // 2^53: larger integers are not exact in double
constexpr int kMaxRounds = 32;                   // of separating vertices; then all are separated

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const std::int64_t part : cell) {
      hash ^= static_cast<std::uint64_t>(part);
      hash *= 0xff51afd7ed558ccdu;  // finalizer of MurmurHash3, A. Appleby
      hash ^= hash >> 33u;
    }
    return static_cast<std::size_t>(hash);
  }
};

Cell gridCell(const glm::dvec3& p, double size) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor(p[axis] / size);
    if (!(std::abs(index) < kMaxCell))
      throw Error("weld", "tolerance is too small for the coordinates",
                  fmt::format("more than {}", std::abs(p[axis]) / kMaxCell), fmt::to_string(size));
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(index);
  }
  return cell;
}

// Kept vertices by position, for a positive tolerance. find() returns an earlier vertex to join, or kNone.
class VertexGrid {
 public:
  explicit VertexGrid(double tolerance) : tolerance_(tolerance) {}
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t find(const glm::dvec3& p, const std::vector<glm::dvec3>& kept) const {
    const Cell home = gridCell(p, tolerance_);
    std::uint32_t best = kNone;
    double bestDistance = tolerance_;
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = cells_.find({home[0] + x, home[1] + y, home[2] + z});
          if (found == cells_.end()) continue;
          for (const std::uint32_t other : found->second) {
            const double distance = glm::distance(p, kept[other]);
            if (distance < bestDistance || (distance == bestDistance && other < best)) {
              best = other;
              bestDistance = distance;
            }
          }
        }
    return best;
  }

  void add(const glm::dvec3& p, std::uint32_t index) { cells_[gridCell(p, tolerance_)].push_back(index); }

 private:
  double tolerance_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

// Returns for each vertex the kept vertex that it joins. counts[i] == 0: vertex i joins none.
std::vector<std::uint32_t> findRepresentatives(const Mesh& mesh, double tolerance, const std::vector<char>& counts) {
  VertexGrid grid(tolerance);
  std::vector<glm::dvec3> kept;
  std::vector<std::uint32_t> keptVertex, first(mesh.positions.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    first[i] = i;
    if (counts[i] == 0) continue;
    const std::uint32_t index = grid.find(mesh.positions[i], kept);
    if (index != VertexGrid::kNone) {
      first[i] = keptVertex[index];
      continue;
    }
    grid.add(mesh.positions[i], static_cast<std::uint32_t>(kept.size()));
    kept.push_back(mesh.positions[i]);
    keptVertex.push_back(i);
  }
  return first;
}

// Returns the vertices of edges that were merged from several and have more than two triangles. Duplicate faces and
// faces without area are ignored, because later steps remove them.
std::vector<char> findNonManifoldVertices(const Mesh& mesh, const std::vector<std::uint32_t>& same,
                                          const std::vector<std::uint32_t>& become) {
  // List faces without duplicates.
  std::vector<std::array<std::uint32_t, 6>> faces;  // sorted new vertices, and their old ones
  for (const glm::uvec3& t : mesh.triangles) {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = t[static_cast<int>(k)];
      v[k] = {become[corner], same[corner]};
    }
    std::sort(v.begin(), v.end());
    if (v[0].first == v[1].first || v[1].first == v[2].first) continue;
    if (isWithoutArea(mesh.positions[v[0].first], mesh.positions[v[1].first], mesh.positions[v[2].first])) continue;
    faces.push_back({v[0].first, v[1].first, v[2].first, v[0].second, v[1].second, v[2].second});
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end(),
                          [](const auto& a, const auto& b) { return std::equal(a.begin(), a.begin() + 3, b.begin()); }),
              faces.end());

  // List their edges by new and old vertices.
  std::vector<std::array<std::uint32_t, 4>> edges;
  for (const auto& f : faces)
    for (const auto& [i, j] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u)})
      edges.push_back({f[i], f[j], std::min(f[3 + i], f[3 + j]), std::max(f[3 + i], f[3 + j])});
  std::sort(edges.begin(), edges.end());

  // Find merged edges with more than two triangles.
  std::vector<char> nonManifold(mesh.positions.size(), 0);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    bool several = false;
    for (; end < edges.size() && edges[end][0] == edges[begin][0] && edges[end][1] == edges[begin][1]; ++end)
      several = several || edges[end][2] != edges[begin][2] || edges[end][3] != edges[begin][3];
    if (several && end - begin > 2) nonManifold[edges[begin][0]] = nonManifold[edges[begin][1]] = 1;
  }
  return nonManifold;
}

}  // namespace

Weld weld(Mesh& mesh, double tolerance) {
  // Join vertices at equal positions, then those within the tolerance.
  const std::size_t count = mesh.positions.size();
  const std::vector<std::uint32_t> same = positionIds(mesh);
  std::vector<std::uint32_t> become = same;
  Weld result;
  if (tolerance > 0) {
    std::vector<char> isFirst(count, 0);  // and used by a face: unused vertices attract no others
    for (const glm::uvec3& t : mesh.triangles) isFirst[same[t.x]] = isFirst[same[t.y]] = isFirst[same[t.z]] = 1;
    std::vector<std::uint32_t> near = findRepresentatives(mesh, tolerance, isFirst);

    // Separate vertices at non-manifold edges again. This may change other edges, so repeat.
    bool changed = true;
    for (int round = 0; changed; ++round) {
      changed = false;
      for (std::uint32_t i = 0; i < count; ++i) become[i] = near[same[i]];
      const std::vector<char> nonManifold = findNonManifoldVertices(mesh, same, become);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t to = near[i];
        if (isFirst[i] == 0 || to == i || !(nonManifold[to] != 0 || round == kMaxRounds)) continue;
        result.refused.add([&] { return findingAt(mesh, mesh.positions[i], {}, {i, to}); });
        near[i] = i;
        changed = true;
      }
    }
  }

  // Select the kept vertices. Normals belong to the old vertices and are dropped.
  std::vector<std::uint32_t> kept, newIndex(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (become[i] == i) {
      newIndex[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(i);
      continue;
    }
    result.joined.add([&] { return findingAt(mesh, mesh.positions[i], {}, {i, become[i]}); });
    newIndex[i] = newIndex[become[i]];  // an earlier vertex, whose index is known
  }
  if (kept.size() < count) {
    mesh.normals.clear();
    selectVertices(mesh, kept, newIndex);
  }
  return result;
}

}  // namespace malus::prep
