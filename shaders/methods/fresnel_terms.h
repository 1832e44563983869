// Interface terms of the methods with the exact unpolarized reflectance: the mean of R_s and R_p per colour.

struct FresnelTerms {
  real3 r;
};

FN FresnelTerms selectTerms(mask m, FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.r = select3(m, a.r, b.r);
  return f;
}
// Transmission T = 1 - R.
FN FresnelTerms transmissionTerms(FresnelTerms reflection) {
  FresnelTerms f;
  f.r = splat3(R(1.0)) - reflection.r;
  return f;
}
FN real meanReflectance(Reflectance f) { return R(0.5) * (f.rs + f.rp); }

FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.r = make3(meanReflectance(red), meanReflectance(green), meanReflectance(blue));
  return f;
}

#include "shaders/methods/exact_terms.h"

FN real3 meanTransmittance(FresnelTerms f) { return splat3(R(1.0)) - f.r; }
