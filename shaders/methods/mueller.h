// Light of the methods that carry Stokes vectors: light about to meet, or leaving, a surface
// is a Stokes vector in the surface's frame (x = s). A ray carries it in its canonical frame.

#include "shaders/methods/mueller_factors.h"

struct Light {
  Stokes stokes;
};

FN Light lightUnpolarized(real3 radiance) {
  Light l;
  l.stokes = stokesUnpolarized(radiance);
  return l;
}
FN Light lightAdd(Light a, Light b) {
  Light l;
  l.stokes = stokesAdd(a.stokes, b.stokes);
  return l;
}
// Linear polarization of a degree from -1 to 1 along s.
FN Light lightPolarized(real3 radiance, real degree) {
  Light l = lightUnpolarized(radiance);
  l.stokes.s1 = radiance * degree;
  return l;
}
FN Light lightScale(Light a, real3 scale) {
  Light l;
  l.stokes.s0 = a.stokes.s0 * scale;
  l.stokes.s1 = a.stokes.s1 * scale;
  l.stokes.s2 = a.stokes.s2 * scale;
  l.stokes.s3 = a.stokes.s3 * scale;
  return l;
}
FN Light lightReflect(Factors f, Light l) {
  Light r;
  r.stokes = stokesInterface(l.stokes, f.rs, f.rp, f.xRe, f.xIm);
  return r;
}
FN Light lightTransmit(Factors f, Light l) {
  real3 ts = splat3(R(1.0)) - f.rs;
  real3 tp = splat3(R(1.0)) - f.rp;
  real3 product = ts * tp;
  Light r;
  r.stokes =
      stokesInterface(l.stokes, ts, tp, make3(sqrtR(product.x), sqrtR(product.y), sqrtR(product.z)), splat3(R(0.0)));
  return r;
}
FN Light lightLeave(Factors f, real3 radiance) { return lightTransmit(f, lightUnpolarized(radiance)); }

FN real3 surfaceS(real3 d, real3 n) { return sDirection(d, n); }

// From the canonical frame of a ray in direction d to the frame of a surface with s direction s, and back.
FN Stokes stokesToSurface(Stokes a, real3 d, real3 s) {
  real cos2;
  real sin2;
  canonicalTurn(d, s, cos2, sin2);
  return stokesTurn(a, cos2, sin2);
}
FN Stokes stokesFromSurface(Stokes a, real3 d, real3 s) {
  real cos2;
  real sin2;
  canonicalTurn(d, s, cos2, sin2);
  return stokesTurn(a, cos2, R(0.0) - sin2);
}
