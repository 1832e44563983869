// The imaginary part of the index of a dielectric.
#pragma once

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"

namespace malus::bake {

// Converts the k of a dielectric, which has none: in the medium of a body it is absorption, 4 pi k / wavelength per
// metre (M. Born, E. Wolf, Principles of Optics); of other surfaces a small one is left out. Throws Error, without a
// location, if k is larger than kMostDielectricK.
void convertDielectricK(const glm::dvec3& wavelengthsNm, pack::Material& material);

// Largest k of a dielectric from a file; the reflectance, which is computed without it, changes by less than k^2/(n +
// 1)^2.
inline constexpr double kMostDielectricK = 0.01;

}  // namespace malus::bake
