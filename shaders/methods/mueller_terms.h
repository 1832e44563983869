// Interface terms of the methods with Stokes or importance vectors, per colour. Transmission follows from
// reflection: T_s, T_p = 1 - R_s, 1 - R_p and, on S2 and S3, the root of their product.

struct FresnelTerms {
  real3 rs;
  real3 rp;
  real3 xRe;
  real3 xIm;
};

FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.rs = make3(red.rs, green.rs, blue.rs);
  f.rp = make3(red.rp, green.rp, blue.rp);
  f.xRe = make3(red.xRe, green.xRe, blue.xRe);
  f.xIm = make3(red.xIm, green.xIm, blue.xIm);
  return f;
}

#include "shaders/methods/exact_terms.h"

FN real3 meanTransmittance(FresnelTerms f) { return splat3(R(1.0)) - (f.rs + f.rp) * R(0.5); }
