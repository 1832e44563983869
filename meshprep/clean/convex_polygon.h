// Triangulation of convex polygons, including collinear corners, without triangles of zero area. Takes linear time, for
// polygons of millions of corners.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/clean/flat_polygon.h"

namespace malus::prep {

// Returns true if no corner turns right and the boundary winds once.
bool isConvex(const FlatPolygon& flat);

// Appends the triangles of a convex polygon: a fan around the first suitable corner. If there is none, because every
// corner ends a side with collinear corners, such sides are clipped first. Returns false, without triangles, if the
// polygon has no area.
bool addConvex(const FlatPolygon& flat, std::vector<glm::uvec3>& triangles);

}  // namespace malus::prep
