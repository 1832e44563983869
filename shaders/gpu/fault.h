// Faults: the unphysical values that --check-numerics finds. C++ and GLSL share these structs, in GLSL's scalar block
// layout.
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
using FaultKind = uint;
#endif

struct Fault {
  uint kind;  // kNotFinite, ... of constants.h; kNoFault: none
  uint x;     // pixel of the whole image
  uint y;
  int bounce;      // specular interactions between the camera and this surface
  uint material;   // index, or kEnvironment
  uint colour;     // 0 red, 1 green, 2 blue
  float cosine;    // of incidence
  float slack;     // rounding error that is allowed
  vec3 position;   // of the hit
  vec3 direction;  // of the ray
  vec3 normal;     // shading normal, on the side of the ray
  vec4 stokes;     // sent from the surface toward the camera, in the ray's canonical frame
};

struct Faults {
  uint count;       // unphysical values
  uint firstPixel;  // y * width + x of the first pixel that has one
  Fault fault;      // only in an image of one pixel
};

#ifdef __cplusplus
static_assert(sizeof(Faults) == 92);
}  // namespace malus::gpu
#endif
