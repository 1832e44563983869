// Splits what touches itself: afterwards no edge has more than two triangles and every vertex has one fan, the
// triangles around it that hang together through edges. Positions and triangles stay where they are.
//
// On an edge of more than two triangles, those that enclose something between their backs stay together (taken around
// the edge like brackets, first within what hangs together elsewhere, then among the rest); one that is left over
// gets an edge of its own. Two triangles of the same three vertices, back to back, are two sheets. Then every fan of a
// vertex gets a vertex of its own: the fan with the smallest vertex of the file keeps the old one, so that a file whose
// vertices were apart, and were welded, gets them back in its order. An edge that is still crowded, because its pairs
// hang together around both ends, is cut in the middle, each pair with a vertex of its own there. Source: A. Gueziec,
// G. Taubin, F. Lazarus, W. Horn, "Cutting and stitching: converting sets of polygons to manifold surfaces", IEEE TVCG
// 7(2), 2001.
#pragma once

#include <string_view>

#include "meshprep/findings.h"

namespace malus::prep {

struct Fans {
  Findings edges;              // of more than two triangles, taken apart
  Findings vertices;           // of more than one fan, split
  std::uint64_t cutEdges = 0;  // edges that were cut in the middle
  bool changed() const { return vertices.count > 0 || cutEdges > 0; }
};

// Sides should agree (orient.h). Triangles must have three different vertices and area. Drops mesh.normals where it
// changes anything. Throws Error that names `where` for what is no surface: more than four fans a vertex, and 65536.
Fans splitFans(Mesh& mesh, std::string_view where = "mesh");

}  // namespace malus::prep
