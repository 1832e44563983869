// Deviation of two surfaces from each other: distance and normals.
#pragma once

#include "meshprep/mesh.h"
#include "meshprep/simplify/surface.h"

namespace malus::prep {

// An upper bound, in metres, of the distance of any point of `from` to `to`. It is not only sampled: triangles of
// `from` are subdivided until the distance of their corners bounds that of all their points, because the distance to a
// triangle is convex and the distance to a surface changes by no more than the way that a point moves. The bound is
// within 1 % or `tolerance`, whichever is larger, of the exact value, unless more than 64 subdivisions per triangle
// would be necessary; it is then larger, never smaller. `tolerance` in metres, over 0. Source of the idea: M. Guthe, P.
// Borodin, R. Klein, "Fast and accurate Hausdorff distance calculation between meshes", Journal of WSCG 13(2), 2005.
double maxDistance(const Mesh& from, const Surface& to, double tolerance);

// The largest angle, in degrees, between a triangle of `from` and the most similar triangle of `to` among those that
// are not farther from its centroid than `reach` metres, or than the nearest one. Triangles without area are left out.
double maxNormalDeviation(const Mesh& from, const Surface& to, double reach);

}  // namespace malus::prep
