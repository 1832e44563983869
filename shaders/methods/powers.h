// Factors of the methods that keep s and p powers apart (the paper's): R_s, R_p for reflection and
// T_s, T_p = 1 - R_s, 1 - R_p, which for lossless dielectrics are the flux transmittances (0 in total
// reflection) and for conductors the paper's weight of the diffuse light below.

struct Factors {
  real3 rs;
  real3 rp;
};

FN Factors exactFactors(Reflectance red, Reflectance green, Reflectance blue) {
  Factors f;
  f.rs = make3(red.rs, green.rs, blue.rs);
  f.rp = make3(red.rp, green.rp, blue.rp);
  return f;
}

#include "shaders/methods/exact_factors.h"

FN real3 meanTransmittance(Factors f) { return splat3(R(1.0)) - (f.rs + f.rp) * R(0.5); }

// Light about to meet, or leaving, a surface: powers along the surface's s and p directions.
struct Light {
  real3 s;
  real3 p;
};

FN Light lightUnpolarized(real3 radiance) {
  Light l;
  l.s = radiance * R(0.5);
  l.p = l.s;
  return l;
}
FN Light lightAdd(Light a, Light b) {
  Light l;
  l.s = a.s + b.s;
  l.p = a.p + b.p;
  return l;
}
// Linear polarization of a degree from -1 to 1 along s.
FN Light lightPolarized(real3 radiance, real degree) {
  Light l;
  l.s = radiance * (R(0.5) + R(0.5) * degree);
  l.p = radiance * (R(0.5) - R(0.5) * degree);
  return l;
}
FN Light lightScale(Light a, real3 scale) {
  Light l;
  l.s = a.s * scale;
  l.p = a.p * scale;
  return l;
}
FN Light lightReflect(Factors f, Light l) {
  Light r;
  r.s = f.rs * l.s;
  r.p = f.rp * l.p;
  return r;
}
FN Light lightTransmit(Factors f, Light l) {
  Light r;
  r.s = (splat3(R(1.0)) - f.rs) * l.s;
  r.p = (splat3(R(1.0)) - f.rp) * l.p;
  return r;
}
FN Light lightLeave(Factors f, real3 radiance) { return lightTransmit(f, lightUnpolarized(radiance)); }

FN real3 surfaceS(real3 d, real3 n) { return sDirection(d, n); }

// Stokes vector, in the canonical frame, of powers along a unit direction s across the ray and across s.
// s = 0 stands for light without a direction, whose powers are equal.
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
