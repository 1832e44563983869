// Certification of a mesh as glass. In a mesh that is not certified, a ray that enters may not leave, or leave twice,
// and the renderers' record of the medium around a ray becomes wrong without an error.
//
// A solid: every component is closed, orientable, has a volume, and is oriented outward (inward if it is a cavity:
// orient.h). No edge has more than two triangles. No triangles cross, coincide, or touch outside of their shared
// corners and edges. No component is inside another one with the same orientation. This is checked for the cleaned
// mesh, in double and in its own space; intersections are checked again after rounding, and in a scene for all bodies
// together (bake/meshes/glass_bodies.h).
//
// An open surface: every component is orientable, and has an opposite surface: the ray from a face against its normal
// leaves through the front of another face. This is sampled. A single interface, such as the surface of a lake, is not
// certified.
#pragma once

#include "meshprep/certify/certificate.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/clean/orient.h"

namespace malus::prep {

// Findings of cleaning, for the current mesh, before normals split its vertices.
struct GlassEvidence {
  const OrientResult& orientation;
  const Intersections& intersections;
};

// Reports the number and the first of each kind of problem per component.
Certificate certifyGlass(const Mesh& mesh, bool openSurface, const GlassEvidence& evidence);

}  // namespace malus::prep
