// Whether a mesh can be a body that light passes through: where it is not, a ray that enters never leaves, or leaves
// twice, and the renderers' record of what it is inside of goes wrong without a word.
//
// A body: every component closed, its two sides told apart, with an inside, turned outward (inward where it is a
// cavity: orient.h), without edges of more than two triangles, without triangles that cross, touch but in corners and
// edges of both, or lie on each other. It holds for the mesh as it is cleaned, in double and in its own space: not for
// what another mesh of the scene does to it, nor for what rounding to float and to a grid may bring into contact. A
// sheet, open on purpose: only that the two sides of every component are told apart, and that it has a partner: behind
// every triangle, against its normal, lies one of the mesh that is left by its front. A single interface, such as the
// surface of a lake, is no pair.
#pragma once

#include "meshprep/certify/certificate.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/clean/orient.h"

namespace malus::prep {

// What cleaning found: of the mesh as it is now, before normals split its vertices.
struct GlassEvidence {
  const OrientResult& sides;
  const Intersections& intersections;
};

// The first problem of each kind is told for every component.
Certificate certifyGlass(const Mesh& mesh, bool sheet, const GlassEvidence& evidence);

}  // namespace malus::prep
