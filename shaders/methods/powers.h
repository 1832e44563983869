// FresnelTerms of the methods that carry s and p powers (those of the paper): R_s, R_p for reflection and
// T_s, T_p = 1 - R_s, 1 - R_p, which for lossless dielectrics are the flux transmittances (0 in total
// reflection) and for conductors the paper's weight of the diffuse light below.

struct FresnelTerms {
  real3 rs;
  real3 rp;
};

FN FresnelTerms selectTerms(mask m, FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.rs = select3(m, a.rs, b.rs);
  f.rp = select3(m, a.rp, b.rp);
  return f;
}
// Of two shares of a surface: at most 1.
FN FresnelTerms addTerms(FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.rs = min3(a.rs + b.rs, R(1.0));
  f.rp = min3(a.rp + b.rp, R(1.0));
  return f;
}
FN FresnelTerms scaleTerms(FresnelTerms a, real3 scale) {
  FresnelTerms f;
  f.rs = a.rs * scale;
  f.rp = a.rp * scale;
  return f;
}
// Transmission T_s = 1 - R_s, T_p = 1 - R_p.
FN FresnelTerms transmissionTerms(FresnelTerms reflection) {
  FresnelTerms f;
  f.rs = splat3(R(1.0)) - reflection.rs;
  f.rp = splat3(R(1.0)) - reflection.rp;
  return f;
}
FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.rs = make3(red.rs, green.rs, blue.rs);
  f.rp = make3(red.rp, green.rp, blue.rp);
  return f;
}

#include "shaders/methods/exact_terms.h"

FN real3 meanTransmittance(FresnelTerms f) { return splat3(R(1.0)) - (f.rs + f.rp) * R(0.5); }
FN real3 transmittanceDifference(FresnelTerms f) { return (f.rp - f.rs) * R(0.5); }

// Light before and after an interaction: powers along the s and p directions of the surface.
struct SurfaceLight {
  real3 s;
  real3 p;
};

FN SurfaceLight lightUnpolarized(real3 radiance) {
  SurfaceLight l;
  l.s = radiance * R(0.5);
  l.p = l.s;
  return l;
}
FN SurfaceLight lightAdd(SurfaceLight a, SurfaceLight b) {
  SurfaceLight l;
  l.s = a.s + b.s;
  l.p = a.p + b.p;
  return l;
}
// Linear polarization of a degree from -1 to 1 along s.
FN SurfaceLight lightPolarized(real3 radiance, real degree) {
  SurfaceLight l;
  l.s = radiance * (R(0.5) + R(0.5) * degree);
  l.p = radiance * (R(0.5) - R(0.5) * degree);
  return l;
}
FN SurfaceLight lightFromStokes(Stokes s) {
  SurfaceLight l;
  l.s = (s.s0 + s.s1) * R(0.5);
  l.p = (s.s0 - s.s1) * R(0.5);
  return l;
}
FN real3 lightRadiance(SurfaceLight l) { return l.s + l.p; }
FN SurfaceLight lightScale(SurfaceLight a, real3 scale) {
  SurfaceLight l;
  l.s = a.s * scale;
  l.p = a.p * scale;
  return l;
}
FN SurfaceLight lightThroughInterface(FresnelTerms f, SurfaceLight l) {
  SurfaceLight r;
  r.s = f.rs * l.s;
  r.p = f.rp * l.p;
  return r;
}
FN SurfaceLight lightFromBelow(FresnelTerms f, real3 radiance) {
  return lightThroughInterface(transmissionTerms(f), lightUnpolarized(radiance));
}

FN real3 surfaceS(real3 d, real3 n) { return sDirection(d, n); }

// Stokes vector, in the canonical frame, of powers along a unit direction s across the ray and across s.
// s = 0 means light without a direction, whose powers are equal.
FN Stokes stokesOfPowers(real3 s, real3 p, real3 sDir, real3 d) {
  real3 x;
  real3 y;
  canonicalFrame(d * R(-1.0), x, y);
  real a = dot3(sDir, x);
  real b = dot3(sDir, y);
  Stokes k;
  k.s0 = s + p;
  k.s1 = (s - p) * ((a - b) * (a + b));
  k.s2 = (s - p) * (R(2.0) * a * b);
  k.s3 = splat3(R(0.0));
  return k;
}
