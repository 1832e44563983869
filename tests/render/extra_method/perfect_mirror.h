// Method `perfect-mirror`: a colour; interfaces reflect all light. 12 bytes.

CONST int kPayloadBytes = 12;
CONST int kHasStokes = 0;

struct Payload {
  real3 colour;
};
struct SurfaceLight {
  real3 colour;
};

#include "shaders/methods/colour_terms.h"

FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.r = splat3(R(1.0));
  return f;
}

#include "shaders/methods/exact_terms.h"

#include "shaders/methods/colour.h"
