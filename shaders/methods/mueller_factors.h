// What methods with Stokes vectors, and importance rows, need of an interface, per colour. Transmission follows from
// reflection: T_s, T_p = 1 - R_s, 1 - R_p and, on S2 and S3, the root of their product.

struct Factors {
  real3 rs;
  real3 rp;
  real3 xRe;
  real3 xIm;
};

FN Factors exactFactors(Reflectance red, Reflectance green, Reflectance blue) {
  Factors f;
  f.rs = make3(red.rs, green.rs, blue.rs);
  f.rp = make3(red.rp, green.rp, blue.rp);
  f.xRe = make3(red.xRe, green.xRe, blue.xRe);
  f.xIm = make3(red.xIm, green.xIm, blue.xIm);
  return f;
}

#include "shaders/methods/exact_factors.h"

FN real3 meanTransmittance(Factors f) { return splat3(R(1.0)) - (f.rs + f.rp) * R(0.5); }
