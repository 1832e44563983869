// Interface terms of the methods with Stokes or importance vectors, per colour. Transmission follows from
// reflection: T_s, T_p = 1 - R_s, 1 - R_p and, on S2 and S3, the root of their product.

struct FresnelTerms {
  real3 rs;
  real3 rp;
  real3 xRe;
  real3 xIm;
};

FN FresnelTerms selectTerms(mask m, FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.rs = select3(m, a.rs, b.rs);
  f.rp = select3(m, a.rp, b.rp);
  f.xRe = select3(m, a.xRe, b.xRe);
  f.xIm = select3(m, a.xIm, b.xIm);
  return f;
}
// Of two shares of a surface: at most 1.
FN FresnelTerms addTerms(FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.rs = min3(a.rs + b.rs, R(1.0));
  f.rp = min3(a.rp + b.rp, R(1.0));
  f.xRe = a.xRe + b.xRe;
  f.xIm = a.xIm + b.xIm;
  return f;
}
FN FresnelTerms scaleTerms(FresnelTerms a, real3 scale) {
  FresnelTerms f;
  f.rs = a.rs * scale;
  f.rp = a.rp * scale;
  f.xRe = a.xRe * scale;
  f.xIm = a.xIm * scale;
  return f;
}
// Transmission of a dielectric without a film, whose terms are the same for all colours, in the form of a reflection:
// T_s = 1 - R_s, T_p = 1 - R_p, X = sqrt(T_s T_p).
FN FresnelTerms transmissionTerms(FresnelTerms reflection) {
  real ts = R(1.0) - reflection.rs.x;
  real tp = R(1.0) - reflection.rp.x;
  FresnelTerms f;
  f.rs = splat3(ts);
  f.rp = splat3(tp);
  f.xRe = splat3(sqrtR(ts * tp));
  f.xIm = splat3(R(0.0));
  return f;
}
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
FN real3 transmittanceDifference(FresnelTerms f) { return (f.rp - f.rs) * R(0.5); }
