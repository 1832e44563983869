// Method `perfect-mirror`: a colour; interfaces reflect all light. 12 bytes.

CONST int kPayloadBytes = 12;
CONST int kHasStokes = 0;

struct Payload {
  real3 colour;
};
struct SurfaceLight {
  real3 colour;
};
struct FresnelTerms {
  real3 r;
};
FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.r = splat3(R(1.0));
  return f;
}

FN FresnelTerms selectTerms(mask m, FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.r = select3(m, a.r, b.r);
  return f;
}
FN FresnelTerms transmissionTerms(FresnelTerms reflection) {
  FresnelTerms f;
  f.r = splat3(R(1.0)) - reflection.r;
  return f;
}

#include "shaders/methods/exact_terms.h"

FN real3 meanTransmittance(FresnelTerms f) { return splat3(R(1.0)) - f.r; }

#include "shaders/methods/colour.h"
