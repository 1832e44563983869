// Diagonals that several faces would share.
//
// Two faces that meet in two consecutive edges (a vertex of valence 2 between them) may both be cut along the line that
// connects the other ends of these edges, and a diagonal may connect two corners that are already connected by an edge
// of other faces. Such an edge has more than two triangles: the closed surface of the file would get a hole. These
// faces are cut again along other diagonals, where that is possible. Two faces with the same corners are the sides
// of a doubled surface and keep their diagonals.
#pragma once

#include <cstdint>
#include <vector>

#include "meshprep/mesh.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

// Largest face that is cut again.
inline constexpr std::size_t kMaxRecutCorners = 64;

// firstTriangle: for each face of the polygons, its first triangle in the mesh, and the number of triangles at the end.
// The triangles of a face are consecutive. Returns the number of faces that were cut again; their triangles keep their
// number.
std::uint64_t recutSharedDiagonals(const Polygons& polygons, const std::vector<std::size_t>& firstTriangle, Mesh& mesh);

}  // namespace malus::prep
