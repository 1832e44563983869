// Bodies of glass of a scene beside each other: contacts between them and nesting, before and after rounding.
//
// meshprep/certify/glass.h certifies each mesh alone, in the coordinates of its file. Here all certified bodies are
// inspected together, in the coordinates of the scene: first as placed, then as rounded for the renderers. Open
// surfaces are not inspected.
#pragma once

#include <string>
#include <vector>

#include "bake/meshes/body_contacts.h"
#include "bake/pack/scene.h"
#include "meshprep/compress/rounding.h"

namespace malus::bake {

// Checks the bodies as placed. Returns a warning for each pair of bodies that cross or touch: interfaces in one place
// have no order. Throws Error that names the meshes: a body that is given twice, or is inside another one whose index
// is not the outsideEta of its material. allowed: these are warnings too.
std::vector<std::string> inspectBodies(const pack::Scene& scene, const GlassBodies& bodies, bool allowed);

// Inspects the rounded bodies: none may cross or touch where they do not as placed. Refuses the finest grids by an
// Error that names the meshes, the faces and the distance that would suffice. The scene must outlive the result.
compress::Inspection glassInspection(const pack::Scene& scene, GlassBodies bodies);

}  // namespace malus::bake
