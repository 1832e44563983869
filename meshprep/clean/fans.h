// Splitting of non-manifold edges and vertices: afterwards every edge has at most two triangles, and every vertex one
// fan of triangles that are connected through edges. Positions and triangles do not move.
//
// At an edge of more than two triangles, those that enclose a volume between their backs stay together: they are paired
// like brackets in angular order, first within components, then among the rest. An unpaired triangle gets a separate
// edge. Two triangles of the same vertices, back to back, are separated. Then every fan gets a separate vertex. The fan
// with the smallest source vertex keeps the old one, so that welded vertices of a file are restored in order. An edge
// that is still non-manifold, because its pairs are connected around both ends, is cut in the middle with a vertex per
// pair. Source: A. Gueziec, G. Taubin, F. Lazarus, W. Horn, "Cutting and stitching: converting sets of polygons to
// manifold surfaces", IEEE TVCG 7(2), 2001.
#pragma once

#include <span>
#include <string_view>

#include "meshprep/clean/edges.h"
#include "meshprep/findings.h"

namespace malus::prep {

struct Fans {
  Findings edges;              // of more than two triangles, separated
  Findings vertices;           // of several fans, split
  std::uint64_t cutEdges = 0;  // edges cut in the middle
  bool changed() const { return vertices.count > 0 || cutEdges > 0; }
};

// Triangles should be oriented (orient.h) and must have three different vertices and area. Drops mesh.normals if it
// changes the mesh. Throws Error at `where` if there are more than 65536 fans and four per vertex: the faces are
// random. edges: edgeUses() of the triangles.
Fans splitFans(Mesh& mesh, std::span<const EdgeUse> edges, std::string_view where = "mesh");

}  // namespace malus::prep
