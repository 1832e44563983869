// Holes of a surface: loops of edges with one triangle. They are reported, and filled on request with triangles of the
// loop's vertices (triangulate.h).
#pragma once

#include <span>
#include <vector>

#include "meshprep/clean/edges.h"
#include "meshprep/findings.h"

namespace malus::prep {

// Vertices around a hole, in the orientation of a face that fills it.
using Loop = std::vector<std::uint32_t>;

// Returns the holes in the order of their smallest vertices. Every vertex must have one fan (fans.h). Ignores edges
// whose loop does not close, because the surface is not oriented consistently.
std::vector<Loop> findHoles(std::span<const EdgeUse> edges);

// Returns a finding per hole: vertices, centre, number of edges and length.
Findings describeHoles(const Mesh& mesh, const std::vector<Loop>& loops);

struct FilledHoles {
  Findings filled;
  Findings left;  // too long, self-crossing, without area, or in conflict with an existing face or edge, or the cap
                  // would touch the surface or another cap elsewhere than at the hole's edges
};

// Fills holes of at most maxEdges edges. Appends the triangles with the source face of a neighbour of the hole.
FilledHoles fillHoles(Mesh& mesh, const std::vector<Loop>& loops, std::uint64_t maxEdges);

}  // namespace malus::prep
