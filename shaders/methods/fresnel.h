// Method `fresnel`: a colour, reflected by the exact mean of R_s and R_p. 12 bytes.

CONST int kPayloadBytes = 12;
CONST int kHasStokes = 0;

struct Payload {
  real3 colour;
};
struct SurfaceLight {
  real3 colour;
};

#include "shaders/methods/fresnel_terms.h"

#include "shaders/methods/colour.h"
