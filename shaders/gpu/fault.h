// What --check-numerics finds: the first value of a picture that no light can have, and where it arose. Laid out by
// GLSL's scalar rules for C++ and GLSL.
#ifdef __cplusplus
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "shaders/gpu/constants.h"

namespace malus::gpu {
using uint = std::uint32_t;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
enum FaultKind : uint { kNoFault, kNotFinite, kNegative, kOverPolarized };
#else
const uint kNoFault = 0u;
const uint kNotFinite = 1u;      // NaN or infinity
const uint kNegative = 2u;       // S0 below 0 by more than rounding explains
const uint kOverPolarized = 3u;  // |(S1, S2, S3)| above S0 by more than rounding explains
#endif

struct Fault {
  uint kind;  // FaultKind
  uint x;     // pixel of the whole picture
  uint y;
  int bounce;      // specular interactions between the eye and this surface
  uint material;   // index, or kEnvironment
  uint colour;     // 0 red, 1 green, 2 blue
  float cosine;    // of incidence
  float slack;     // what rounding explains
  vec3 position;   // of the hit
  vec3 direction;  // of the ray
  vec3 normal;     // shading normal, against the ray
  vec4 stokes;     // what the surface sends toward the eye, in the ray's canonical frame
};

// Binding 11.
struct Faults {
  uint count;       // values at fault
  uint firstPixel;  // y * width + x of the first pixel that has one
  Fault fault;      // of the only pixel of a picture of one pixel
};

#ifdef __cplusplus
static_assert(sizeof(Faults) == 92);
}  // namespace malus::gpu
#endif
