// Ids of the positions of a mesh: vertices with equal positions have equal ids.
#pragma once

#include <cstdint>
#include <vector>

#include "meshprep/mesh.h"

namespace malus::prep {

// Returns an id per vertex: the first vertex at its position. Positive and negative zero are equal.
std::vector<std::uint32_t> positionIds(const Mesh& mesh);

}  // namespace malus::prep
