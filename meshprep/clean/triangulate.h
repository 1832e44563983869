// Polygons to triangles. Convex faces become a fan around a corner that leaves no triangle without area;
// others lose one ear after the other (G. H. Meisters, "Polygons have ears", American Mathematical Monthly
// 82, 1975), in the plane of Newell's normal (I. Sutherland, R. Sproull, R. Schumacker, "A characterization
// of ten hidden-surface algorithms", ACM Computing Surveys 6(1), 1974, appendix). Orientation is kept;
// triangles of the file are taken as they are. Triangles of a face follow each other; faces keep their order.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

struct TriangulateCounts {
  std::uint64_t polygons = 0;         // faces of more than three corners
  std::uint64_t concave = 0;          // of these, not convex
  std::uint64_t nonPlanar = 0;        // of these, a corner off the plane by more than 1e-4 of the size
  std::uint64_t crossing = 0;         // of these, without ears (they cross themselves): made a plain fan
  std::uint64_t repeatedCorners = 0;  // corners of polygons that equal the one before, left out
};

Mesh triangulate(const Polygons& polygons, TriangulateCounts& counts);

}  // namespace malus::prep
