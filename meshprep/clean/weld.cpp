#include "meshprep/clean/weld.h"

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

namespace malus::prep {

namespace {

constexpr double kMaxCell = 9007199254740992.0;  // 2^53: whole numbers that a double holds

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

}  // namespace

std::uint64_t weld(Mesh& mesh, double tolerance) {
  // Step 1: keep the first vertex of every place.
  Places places(tolerance);
  std::vector<glm::dvec3> kept;
  std::vector<std::uint32_t> newIndex(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    std::uint32_t index = places.find(mesh.positions[i], kept);
    if (index == Places::kNone) {
      index = static_cast<std::uint32_t>(kept.size());
      places.add(mesh.positions[i], index);
      kept.push_back(mesh.positions[i]);
    }
    newIndex[i] = index;
  }

  // Step 2: let the triangles name the kept ones. Normals belong to the old vertices.
  const std::uint64_t joined = mesh.positions.size() - kept.size();
  for (glm::uvec3& t : mesh.triangles) t = {newIndex[t.x], newIndex[t.y], newIndex[t.z]};
  mesh.positions = std::move(kept);
  mesh.normals.clear();
  return joined;
}

}  // namespace malus::prep
