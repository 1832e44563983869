// Error of the absorption that the single-precision renderers compute. A way through a medium is measured from hit to
// hit (shaders/surfaces/hit.h), and errs by the rounding of both, which grows with the size of oblique faces. Rays
// start off the face (bake/meshes/face_rounding.h), so that they miss a medium that is thinner than that.
#pragma once

#include <optional>

#include "bake/pack/scene.h"

namespace malus::bake {

// Largest relative error of a transmittance that is not reported.
inline constexpr double kAbsorptionPrecision = 1e-3;

struct AbsorptionPrecision {
  double distance;   // bound on the error of a way along the normal of a face, mean of the mesh [m]; with a thickness:
                     // distance at which rays start
  double error;      // relative error of the transmittance by the distance; with a thickness: without the body
  double thickness;  // mean thickness of a body that rays may start beyond [m]; 0: they do not
};

// Whether a medium at surfaces of the material absorbs.
bool absorbs(const pack::Material& material);

// Nothing: the renderers are within kAbsorptionPrecision, or no medium at the mesh absorbs.
std::optional<AbsorptionPrecision> insufficientAbsorptionPrecision(const pack::Mesh& mesh,
                                                                   const pack::Material& material);

}  // namespace malus::bake
