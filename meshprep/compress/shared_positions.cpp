#include "meshprep/compress/shared_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "meshprep/compress/grid_rounding.h"

namespace malus::compress {

namespace {

constexpr std::size_t kMostCompared = 4096;  // meshes whose boxes are compared pairwise

// Cell of a lattice, as coordinates that are compared for equality only.
using Cell = std::array<double, 3>;

struct Entry {
  Cell cell;
  std::uint32_t mesh;
  std::uint32_t vertex;
};

// Adds 0 so that -0 becomes 0, which sorts differently.
Cell makeCell(const glm::dvec3& p, double tolerance) {
  return {std::nearbyint(p.x / tolerance) + 0.0, std::nearbyint(p.y / tolerance) + 0.0,
          std::nearbyint(p.z / tolerance) + 0.0};
}

// Returns the vertices of each mesh inside the bounding box of another mesh.
std::vector<Entry> candidates(std::span<const MeshView> meshes, double tolerance) {
  std::vector<Extent> boxes;
  for (const MeshView& mesh : meshes) {
    boxes.push_back(mesh.positions.empty() ? Extent{glm::dvec3(1), glm::dvec3(-1)} : findExtent(mesh.positions));
    boxes.back().low -= tolerance;
    boxes.back().high += tolerance;
  }
  std::vector<Entry> entries;
  std::vector<Extent> others;
  for (std::uint32_t i = 0; i < meshes.size(); ++i) {
    others.clear();
    const bool many = meshes.size() > kMostCompared;
    for (std::size_t j = 0; j < boxes.size() && !many; ++j)
      if (j != i && glm::all(glm::lessThanEqual(boxes[j].low, boxes[i].high)) &&
          glm::all(glm::lessThanEqual(boxes[i].low, boxes[j].high)))
        others.push_back(boxes[j]);
    if (others.empty() && !many) continue;
    // Many neighbours cost more to test than to sort.
    const bool all = many || others.size() > 8;
    for (std::uint32_t v = 0; v < meshes[i].positions.size(); ++v) {
      const glm::dvec3& p = meshes[i].positions[v];
      const bool inside =
          all || std::any_of(others.begin(), others.end(), [&](const Extent& box) {
            return glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high));
          });
      if (inside) entries.push_back({makeCell(p, tolerance), i, v});
    }
  }
  return entries;
}

std::uint32_t findRoot(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

SharedPositions findSharedPositions(std::span<const MeshView> meshes, double tolerance) {
  SharedPositions shared;
  shared.vertices.resize(meshes.size());
  shared.groupOf.resize(meshes.size());
  std::iota(shared.groupOf.begin(), shared.groupOf.end(), 0u);
  if (!(tolerance > 0)) return shared;

  // Sort the vertices by their cells; a run of several meshes is a shared position.
  std::vector<Entry> entries = candidates(meshes, tolerance);
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.mesh != b.mesh ? a.mesh < b.mesh : a.vertex < b.vertex;
  });
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && entries[end].cell == entries[begin].cell) ++end;
    if (entries[begin].mesh == entries[end - 1].mesh) continue;
    std::vector<std::uint32_t>& users = shared.users.emplace_back();
    for (std::size_t i = begin; i < end; ++i) {
      const Entry& entry = entries[i];
      if (users.empty() || users.back() != entry.mesh) users.push_back(entry.mesh);
      shared.vertices[entry.mesh].emplace_back(entry.vertex, static_cast<std::uint32_t>(shared.users.size() - 1));
    }
    for (const std::uint32_t mesh : users) {
      const std::uint32_t a = findRoot(shared.groupOf, users.front()), b = findRoot(shared.groupOf, mesh);
      shared.groupOf[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t i = 0; i < meshes.size(); ++i) shared.groupOf[i] = findRoot(shared.groupOf, i);
  return shared;
}

}  // namespace malus::compress
