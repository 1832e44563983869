// Method `schlick`: a colour, reflected by Schlick's approximation, as is usual in games. 12 bytes.

CONST int kPayloadBytes = 12;
CONST int kHasStokes = 0;

struct Payload {
  real3 colour;
};
struct SurfaceLight {
  real3 colour;
};

#include "shaders/methods/schlick_terms.h"

#include "shaders/methods/colour.h"
