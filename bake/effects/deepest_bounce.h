// How deep light can be reflected and still be seen.
#pragma once

#include "bake/pack/scene.h"

namespace malus::bake {

// Most interactions, at most `depth`, after which light can still change a pixel by more than `tolerance` of the
// radiance that it then has. Conservative: for every pair of flat faces the most grazing way from one to the other
// bounds the reflectance, and the best chain of them is taken; glass, sheets, films, maps, curved and rough surfaces
// count as 1. A scene of more than kMostFaces interface faces is not analysed: `depth`.
std::uint32_t deepestBounce(const pack::Scene& scene, std::uint32_t depth, double tolerance);
inline constexpr std::size_t kMostFaces = 1000;

}  // namespace malus::bake
