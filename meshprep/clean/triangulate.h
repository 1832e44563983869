// Polygons to triangles. Convex faces of any size become a fan around a corner that leaves no triangle without area
// (convex_polygon.h); others lose one ear after the other (ears.h), in the plane of Newell's normal (I. Sutherland, R.
// Sproull, R. Schumacker, "A characterization of ten hidden-surface algorithms", ACM Computing Surveys 6(1), 1974,
// appendix). Orientation is kept; triangles of the file are taken as they are. Triangles of a face follow each other;
// faces keep their order.
//
// The time is bounded: all faces that are not convex share kEarTests and kEarTestsPerCorner more for each corner of the
// mesh, of a few nanoseconds each. Measured on stars, combs, spirals, zigzags, coasts, bows and random corners: a
// single face of 10,000 corners takes less than 0.1 s; of 100,000 corners smooth and winding outlines pass (0.1 s),
// combs, zigzags and spiky stars are an error.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

constexpr std::uint64_t kEarTests = 150'000'000;
constexpr std::uint64_t kEarTestsPerCorner = 150;

struct TriangulateCounts {
  std::uint64_t polygons = 0;         // faces of more than three corners
  std::uint64_t concave = 0;          // of these, not convex
  std::uint64_t nonPlanar = 0;        // of these, a corner off the plane by more than 1e-4 of the size
  std::uint64_t crossing = 0;         // of these, without ears (they cross themselves): made a plain fan
  std::uint64_t repeatedCorners = 0;  // corners of polygons that equal the one before, left out
};

// Every triangle knows its face, its corners' normals (of the corners, or else of the vertices, as written) and its
// smoothing group, where the polygons have them. Throws Error that names the face and its place: the tests are used
// up.
Mesh triangulate(const Polygons& polygons, TriangulateCounts& counts);

}  // namespace malus::prep
