// Constants that C++ and GLSL share.
#ifdef __cplusplus
#pragma once

#include <cstdint>

namespace malus::gpu {
using uint = std::uint32_t;
#define MALUS_CONSTANT inline constexpr
#else
#define MALUS_CONSTANT const
#endif

MALUS_CONSTANT uint kFacets = 16u;               // microfacets that represent a rough surface (optics/facets.h)
MALUS_CONSTANT uint kNoTexture = 0xffffffffu;    // in place of the index of a texture
MALUS_CONSTANT uint kMeshTexture = 0xfffffffeu;  // in place of that of an index that has a map by mesh coordinates
MALUS_CONSTANT uint kWrapClamp = 1u;             // ways to continue a texture beyond its edges; 0: repeated
MALUS_CONSTANT uint kWrapMirror = 2u;
MALUS_CONSTANT uint kUnplaced = 0u;              // kinds of MeshTransform: none
MALUS_CONSTANT uint kPlaced = 1u;                // one that keeps the sense of rotation
MALUS_CONSTANT uint kMirrored = 2u;              // one that reverses it: corners 1 and 2 of triangles are exchanged
MALUS_CONSTANT uint kEnvironment = 0xffffffffu;  // in place of the index of a material
MALUS_CONSTANT uint kColourChannels = 3u;        // floats per pixel: the colour behind the filter
MALUS_CONSTANT uint kStokesChannels = 15u;       // floats per pixel: the colour, then S0, S1, S2 and S3, each r g b

// Kinds of fault (fault.h).
MALUS_CONSTANT uint kNoFault = 0u;
MALUS_CONSTANT uint kNotFinite = 1u;      // NaN or infinity
MALUS_CONSTANT uint kNegative = 2u;       // S0 < 0, by more than the rounding error
MALUS_CONSTANT uint kOverPolarized = 3u;  // |(S1, S2, S3)| > S0, by more than the rounding error

#undef MALUS_CONSTANT
#ifdef __cplusplus
}  // namespace malus::gpu
#endif
