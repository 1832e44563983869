// Largest depth at which a reflection still changes the image.
#pragma once

#include "bake/pack/scene.h"

namespace malus::bake {

// Returns the largest number of interactions, at most `depth`, at the last of which light can still change a pixel
// by more than `tolerance` of its radiance. Conservative: between each pair of flat faces the most grazing ray
// bounds the reflectance, and the chain of faces with the largest product is taken; glass, polarizing elements, films,
// clear coats, maps, curved and rough surfaces count as a reflectance of 1. Returns `depth` for a scene with more than
// kMostFaces faces of interfaces.
std::uint32_t deepestBounce(const pack::Scene& scene, std::uint32_t depth, double tolerance);
inline constexpr std::size_t kMostFaces = 1000;

}  // namespace malus::bake
