// Edges of a list of triangles, with any number of triangles each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

// Triangle on an edge.
struct EdgeUse {
  std::uint32_t low = 0;  // the edge's vertices, low < high
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  std::uint8_t corner = 0;  // corner of the triangle at which the edge begins
  bool forward = false;     // the triangle traverses it from low to high
};

// Returns three uses per triangle, sorted by edge, then by triangle. Triangles must have three different vertices.
std::vector<EdgeUse> edgeUses(std::span<const glm::uvec3> triangles);

// Calls visit(std::span<const EdgeUse>) for every edge, with all its triangles.
template <class Visit>
void forEachEdge(std::span<const EdgeUse> uses, Visit visit) {
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
    visit(uses.subspan(begin, end - begin));
  }
}

}  // namespace malus::prep
