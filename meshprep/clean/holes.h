// The holes of a surface: loops of edges that only one triangle has. They are told; they are filled only where that is
// asked for, with triangles of the loop's own vertices (triangulate.h).
#pragma once

#include <vector>

#include "meshprep/findings.h"

namespace malus::prep {

// The vertices around a hole, one after the other, the way around that a face filling it has.
using Loop = std::vector<std::uint32_t>;

// In the order of their smallest vertices. Every vertex must have one fan (fans.h); edges whose loop does not close,
// on a surface whose sides do not agree, are left out.
std::vector<Loop> findHoles(const Mesh& mesh);

// Tells the holes: vertices, middle, number of edges and length around.
Findings describeHoles(const Mesh& mesh, const std::vector<Loop>& loops);

struct FilledHoles {
  Findings filled;
  Findings left;  // too long, crossing themselves, along a line, or on a face or over an edge that is there already
};

// Fills those of at most maxEdges edges. Triangles are added at the end, as if cut from a face beside the hole.
FilledHoles fillHoles(Mesh& mesh, const std::vector<Loop>& loops, std::uint64_t maxEdges);

}  // namespace malus::prep
