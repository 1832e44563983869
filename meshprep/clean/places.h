// Numbers the places of a mesh: vertices at equal positions have equal numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "meshprep/mesh.h"

namespace malus::prep {

// One number a vertex: that of the first vertex at its place. Positive and negative zero are equal.
std::vector<std::uint32_t> placeOfVertices(const Mesh& mesh);

}  // namespace malus::prep
