// Proof in floating point that two triangles touch at their shared corners only. It decides almost all pairs and is
// much faster than exact predicates, above all for coplanar triangles.
//
// The triangles are separate if a plane, for shared corners through these, has them on different sides by more than a
// bound of the rounding errors. Differences of corners have a relative error of half an ulp, so the bounds are relative
// to the size of the triangles, not to their distance from the origin. Source: separating axes: S. Gottschalk, M. C.
// Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid interference detection", SIGGRAPH 1996; rounding
// errors: J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete
// and Computational Geometry 18, 1997.
#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace malus::prep {

using TriangleCorners = std::array<glm::dvec3, 3>;  // finite, of magnitudes from 1e-60 to 1e60, or 0

// Returns true if the triangle certainly has an area.
bool certainlyHasArea(const TriangleCorners& a);

// Return true if the triangles certainly do not touch; with one or two shared corners, not outside of these. The shared
// corners are the first of both, in the same order. The triangles must have an area. distance: also if every corner
// moves by at most this distance, shared corners together; then triangles without area certainly do not touch either.
bool areSeparate(const TriangleCorners& a, const TriangleCorners& b, double distance = 0);
bool areSeparateBesideCorner(const TriangleCorners& a, const TriangleCorners& b, double distance = 0);
bool areSeparateBesideEdge(const TriangleCorners& a, const TriangleCorners& b, double distance = 0);

}  // namespace malus::prep
