// Light of the methods that carry Stokes vectors. SurfaceLight, before and after an interaction, is a Stokes vector in
// the frame of the surface (x = s); a payload is one in the canonical frame of its ray.

#include "shaders/methods/mueller_terms.h"

struct SurfaceLight {
  Stokes stokes;
};

FN SurfaceLight lightUnpolarized(real3 radiance) {
  SurfaceLight l;
  l.stokes = stokesUnpolarized(radiance);
  return l;
}
FN SurfaceLight lightAdd(SurfaceLight a, SurfaceLight b) {
  SurfaceLight l;
  l.stokes = stokesAdd(a.stokes, b.stokes);
  return l;
}
// Linear polarization of a degree from -1 to 1 along s.
FN SurfaceLight lightPolarized(real3 radiance, real degree) {
  SurfaceLight l = lightUnpolarized(radiance);
  l.stokes.s1 = radiance * degree;
  return l;
}
FN SurfaceLight lightFromStokes(Stokes s) {
  SurfaceLight l;
  l.stokes = s;
  return l;
}
FN real3 lightRadiance(SurfaceLight l) { return l.stokes.s0; }
FN SurfaceLight lightScale(SurfaceLight a, real3 scale) {
  SurfaceLight l;
  l.stokes.s0 = a.stokes.s0 * scale;
  l.stokes.s1 = a.stokes.s1 * scale;
  l.stokes.s2 = a.stokes.s2 * scale;
  l.stokes.s3 = a.stokes.s3 * scale;
  return l;
}
FN SurfaceLight lightThroughInterface(FresnelTerms f, SurfaceLight l) {
  SurfaceLight r;
  r.stokes = stokesInterface(l.stokes, f.rs, f.rp, f.xRe, f.xIm);
  return r;
}
FN SurfaceLight lightFromBelow(FresnelTerms f, real3 radiance) {
  real3 none = splat3(R(0.0));  // unpolarized light has no S2 and S3
  SurfaceLight r = lightUnpolarized(radiance);
  r.stokes = stokesInterface(r.stokes, splat3(R(1.0)) - f.rs, splat3(R(1.0)) - f.rp, none, none);
  return r;
}

FN real3 surfaceS(real3 d, real3 n) { return sDirection(d, n); }

// From the canonical frame of a ray in direction d to the frame of a surface with s direction s, and back.
FN Stokes stokesToSurface(Stokes a, real3 d, real3 s) {
  real cos2;
  real sin2;
  canonicalRotation(d, s, cos2, sin2);
  return rotateStokes(a, cos2, sin2);
}
FN Stokes stokesFromSurface(Stokes a, real3 d, real3 s) {
  real cos2;
  real sin2;
  canonicalRotation(d, s, cos2, sin2);
  return rotateStokes(a, cos2, R(0.0) - sin2);
}
