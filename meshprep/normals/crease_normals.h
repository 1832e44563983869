// One normal for each smooth piece of surface around a vertex.
//
// Two triangles at a vertex belong together where they share an edge there, no third triangle does, both have
// the same side outward and their normals differ by no more than the crease angle; pieces are what hangs
// together by that. A piece's normal is the mean of its triangles' normals, weighted by their angles at the
// vertex, which does not depend on how a face was cut into triangles.
// Source: G. Thurmer, C. A. Wuethrich, "Computing vertex normals from polygonal facets", Journal of Graphics
// Tools 3(1), 1998.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"

namespace malus::prep {

struct NormalCounts {
  std::uint64_t added = 0;      // vertices that the creases made necessary
  std::uint64_t undefined = 0;  // pieces whose normals cancel: they got their first triangle's
};

// Stores one vertex a piece: vertices in their order, a vertex's pieces by their first triangles. Triangles
// keep their order. creaseDegrees from 0 to 180. Every triangle must have area, every vertex a triangle.
NormalCounts addCreaseNormals(Mesh& mesh, double creaseDegrees);

}  // namespace malus::prep
