// Positions that several meshes share, and groups of meshes that are connected by them.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

struct SharedPositions {
  std::vector<std::uint32_t> groupOf;             // per mesh: the smallest index of a mesh of its group
  std::vector<std::vector<std::uint32_t>> users;  // per shared position: the meshes that have it, at least two
  // Per mesh: vertices at shared positions, as (vertex, index into users).
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> vertices;
};

// Positions are shared if they differ by less than about `tolerance`: rounding errors of transforms.
SharedPositions findSharedPositions(std::span<const MeshView> meshes, double tolerance);

}  // namespace malus::compress
