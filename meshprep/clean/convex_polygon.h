// Convex polygons, corners within a side allowed, into triangles of which none is without area. All of it takes time
// in proportion to the number of corners, so a polygon may have millions of them.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/clean/flat_polygon.h"

namespace malus::prep {

// No corner turns right, and the boundary goes around once.
bool isConvex(const FlatPolygon& flat);

// Adds the triangles of a convex polygon: a fan around the first corner that allows it; where none does because every
// corner ends a side with further corners in it, those sides are cut off first. Returns false, having added nothing,
// where the polygon has no area.
bool addConvex(const FlatPolygon& flat, std::vector<glm::uvec3>& triangles);

}  // namespace malus::prep
