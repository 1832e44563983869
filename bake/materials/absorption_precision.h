// Error of the absorption that the single-precision renderers compute. Their rays start off the face, by a distance
// that grows with the size of the face and of its mesh (shaders/optics/surface_point.h), and the way through a medium
// is measured from there.
#pragma once

#include <optional>

#include "bake/pack/scene.h"

namespace malus::bake {

// Largest relative error of a transmittance that is not reported.
inline constexpr double kAbsorptionPrecision = 1e-3;

struct AbsorptionPrecision {
  double distance;  // by which ways through the medium are too short [m]
  double error;     // relative error of their transmittance, along the normal
};

// Nothing: the renderers are within kAbsorptionPrecision, or no medium at the mesh absorbs.
std::optional<AbsorptionPrecision> insufficientAbsorptionPrecision(const pack::Mesh& mesh,
                                                                   const pack::Material& material);

}  // namespace malus::bake
