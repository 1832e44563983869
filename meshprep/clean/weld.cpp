#include "meshprep/clean/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/degenerate_faces.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

constexpr double kMaxCell = 9007199254740992.0;  // 2^53: whole numbers that a double holds
constexpr int kRounds = 32;                      // of taking vertices apart again; then all of them

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

// Equal positions share a cell: their bits, with one zero.
Cell exactCell(const glm::dvec3& p) {
  const glm::dvec3 oneZero = p + 0.0;
  return {std::bit_cast<std::int64_t>(oneZero.x), std::bit_cast<std::int64_t>(oneZero.y),
          std::bit_cast<std::int64_t>(oneZero.z)};
}

Cell gridCell(const glm::dvec3& p, double size) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor(p[axis] / size);
    if (!(std::abs(index) < kMaxCell))
      throw Error("weld", "the tolerance is too small for the coordinates",
                  fmt::format("more than {}", std::abs(p[axis]) / kMaxCell), fmt::to_string(size));
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(index);
  }
  return cell;
}

// The kept vertices, found by place. Returns an earlier vertex to join, or `none`.
class Places {
 public:
  explicit Places(double tolerance) : tolerance_(tolerance) {}
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t find(const glm::dvec3& p, const std::vector<glm::dvec3>& kept) const {
    if (tolerance_ == 0) {
      const auto found = cells_.find(exactCell(p));
      return found == cells_.end() ? kNone : found->second.front();
    }
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

  void add(const glm::dvec3& p, std::uint32_t index) {
    cells_[tolerance_ == 0 ? exactCell(p) : gridCell(p, tolerance_)].push_back(index);
  }

 private:
  double tolerance_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

// The first vertex of every place, for each vertex.
std::vector<std::uint32_t> firstOfPlace(const Mesh& mesh, double tolerance, const std::vector<char>& counts) {
  Places places(tolerance);
  std::vector<glm::dvec3> kept;
  std::vector<std::uint32_t> keptVertex, first(mesh.positions.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    first[i] = i;
    if (counts[i] == 0) continue;
    const std::uint32_t index = places.find(mesh.positions[i], kept);
    if (index != Places::kNone) {
      first[i] = keptVertex[index];
      continue;
    }
    places.add(mesh.positions[i], static_cast<std::uint32_t>(kept.size()));
    kept.push_back(mesh.positions[i]);
    keptVertex.push_back(i);
  }
  return first;
}

// The vertices of edges that became one of several, and have more than two triangles by that. Copies of faces and faces
// without area, which later steps take away, do not count.
std::vector<char> onCrowdedEdges(const Mesh& mesh, const std::vector<std::uint32_t>& same,
                                 const std::vector<std::uint32_t>& become) {
  // Step 1: faces, once each.
  std::vector<std::array<std::uint32_t, 6>> faces;  // as they become, sorted; as they are
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

  // Step 2: their edges, as they become and as they are.
  std::vector<std::array<std::uint32_t, 4>> edges;
  for (const auto& f : faces)
    for (const auto& [i, j] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u)})
      edges.push_back({f[i], f[j], std::min(f[3 + i], f[3 + j]), std::max(f[3 + i], f[3 + j])});
  std::sort(edges.begin(), edges.end());

  // Step 3: crowded by joining.
  std::vector<char> crowded(mesh.positions.size(), 0);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    bool several = false;
    for (; end < edges.size() && edges[end][0] == edges[begin][0] && edges[end][1] == edges[begin][1]; ++end)
      several = several || edges[end][2] != edges[begin][2] || edges[end][3] != edges[begin][3];
    if (several && end - begin > 2) crowded[edges[begin][0]] = crowded[edges[begin][1]] = 1;
  }
  return crowded;
}

}  // namespace

Weld weld(Mesh& mesh, double tolerance) {
  // Step 1: what is at the same place, then what is near.
  const std::size_t count = mesh.positions.size();
  const std::vector<std::uint32_t> same = firstOfPlace(mesh, 0, std::vector<char>(count, 1));
  std::vector<std::uint32_t> become = same;
  Weld result;
  if (tolerance > 0) {
    std::vector<char> isFirst(count, 0);  // and named by a face: what nobody names pulls nothing to it
    for (const glm::uvec3& t : mesh.triangles) isFirst[same[t.x]] = isFirst[same[t.y]] = isFirst[same[t.z]] = 1;
    std::vector<std::uint32_t> near = firstOfPlace(mesh, tolerance, isFirst);

    // Step 2: apart again where an edge got a third triangle by it. What stays apart may free or crowd other edges.
    bool changed = true;
    for (int round = 0; changed; ++round) {
      changed = false;
      for (std::uint32_t i = 0; i < count; ++i) become[i] = near[same[i]];
      const std::vector<char> crowded = onCrowdedEdges(mesh, same, become);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t to = near[i];
        if (isFirst[i] == 0 || to == i || !(crowded[to] != 0 || round == kRounds)) continue;
        result.refused.add([&] { return findingAt(mesh, mesh.positions[i], {}, {i, to}); });
        near[i] = i;
        changed = true;
      }
    }
  }

  // Step 3: let the triangles name the kept ones. Normals belong to the old vertices.
  std::vector<std::uint32_t> kept, newIndex(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (become[i] == i) {
      newIndex[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(i);
      continue;
    }
    result.joined.add([&] { return findingAt(mesh, mesh.positions[i], {}, {i, become[i]}); });
    newIndex[i] = newIndex[become[i]];  // an earlier vertex
  }
  if (kept.size() < count) {
    mesh.normals.clear();
    takeVertices(mesh, kept, newIndex);
  }
  return result;
}

}  // namespace malus::prep
