// Triangulation of polygons. Convex faces of any size become a fan around a corner for which no triangle has zero area
// (convex_polygon.h); others are clipped by ears (ears.h), in the plane of Newell's normal (I. Sutherland, R. Sproull,
// R. Schumacker, "A characterization of ten hidden-surface algorithms", ACM Computing Surveys 6(1), 1974, appendix).
// Orientation, and the order of faces are kept; triangles of a face are consecutive, and triangles of the file
// unchanged.
//
// Faces that would share a diagonal are cut again (shared_diagonals.h); copies of a face are cut as the first one
// (repeated_polygons.h).
//
// The time is limited: all faces that are not convex share kEarTests, and kEarTestsPerCorner per corner of the mesh, a
// few nanoseconds each. Measured for stars, combs, spirals, zigzags, coastlines, bows and random corners: a face of
// 10,000 corners takes less than 0.1 s; of faces with 100,000 corners, smooth and winding outlines take 0.1 s, and
// combs, zigzags and stars are errors.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

constexpr std::uint64_t kEarTests = 150'000'000;
constexpr std::uint64_t kEarTestsPerCorner = 150;

struct TriangulateCounts {
  std::uint64_t polygons = 0;         // faces of more than three corners
  std::uint64_t concave = 0;          // of these, those that are not convex
  std::uint64_t nonPlanar = 0;        // of these, those with a corner farther than 1e-4 of the size from the plane
  std::uint64_t crossing = 0;         // of these, those without ears, because they cross themselves; a fan is used
  std::uint64_t repeatedCorners = 0;  // corners at the position of the previous one, dropped
  std::uint64_t fewCorners = 0;       // faces of fewer than three corners, dropped
  std::uint64_t recut = 0;            // of polygons, those cut along other diagonals (shared_diagonals.h)
};

// Returns the texture attributes of a corner: an index into Polygons::corners.
CornerTexture cornerTexture(const Polygons& polygons, std::size_t corner);

// Sets source faces, corner normals (those of the corners, or else of the vertices), texture attributes and smoothing
// groups, as far as the polygons have them. Throws Error, with the face and its location, if the tests are exhausted.
Mesh triangulate(const Polygons& polygons, TriangulateCounts& counts);

}  // namespace malus::prep
