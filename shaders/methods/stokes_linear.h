// Method `stokes-linear`: S0 to S2 per colour in the canonical frame of the ray; S3 is dropped at every surface. Exact
// if circular polarization does not change the image. 36 bytes. As mueller.h, without S3.

#include "shaders/methods/mueller_terms.h"

CONST int kPayloadBytes = 36;
CONST int kHasStokes = 1;

struct SurfaceLight {
  real3 s0;
  real3 s1;
  real3 s2;
};
struct Payload {
  SurfaceLight light;
};

FN real payloadDepth(Payload p) { return p.light.s0.x; }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.light.s0.x = depth; }
FN real payloadOriginDistance(Payload p) { return p.light.s0.y; }
FN void payloadSetOriginDistance(INOUT(Payload) p, real distance) { p.light.s0.y = distance; }
FN word payloadPath(Payload p) { return floatBits(p.light.s0.z); }
FN void payloadSetPath(INOUT(Payload) p, word path) { p.light.s0.z = floatValue(path); }

// Linear polarization of a degree from -1 to 1 along s.
FN SurfaceLight lightPolarized(real3 radiance, real degree) {
  SurfaceLight l;
  l.s0 = radiance;
  l.s1 = radiance * degree;
  l.s2 = splat3(R(0.0));
  return l;
}
FN SurfaceLight lightUnpolarized(real3 radiance) { return lightPolarized(radiance, R(0.0)); }
FN SurfaceLight lightFromStokes(Stokes s) {
  SurfaceLight l;
  l.s0 = s.s0;
  l.s1 = s.s1;
  l.s2 = s.s2;
  return l;
}
FN real3 lightRadiance(SurfaceLight l) { return l.s0; }
FN SurfaceLight lightAdd(SurfaceLight a, SurfaceLight b) {
  SurfaceLight l;
  l.s0 = a.s0 + b.s0;
  l.s1 = a.s1 + b.s1;
  l.s2 = a.s2 + b.s2;
  return l;
}
FN SurfaceLight lightScale(SurfaceLight a, real3 scale) {
  SurfaceLight l;
  l.s0 = a.s0 * scale;
  l.s1 = a.s1 * scale;
  l.s2 = a.s2 * scale;
  return l;
}
FN SurfaceLight lightThroughInterface(FresnelTerms f, SurfaceLight a) {
  real3 mean = (f.rs + f.rp) * R(0.5);
  real3 difference = (f.rs - f.rp) * R(0.5);
  SurfaceLight l;
  l.s0 = mean * a.s0 + difference * a.s1;
  l.s1 = difference * a.s0 + mean * a.s1;
  l.s2 = f.xRe * a.s2;
  return l;
}
FN SurfaceLight lightFromBelow(FresnelTerms f, real3 radiance) {
  FresnelTerms t = f;
  t.rs = splat3(R(1.0)) - f.rs;
  t.rp = splat3(R(1.0)) - f.rp;
  return lightThroughInterface(t, lightUnpolarized(radiance));  // unpolarized light has no S2, so that t.xRe is unused
}

FN real3 surfaceS(real3 d, real3 n) { return sDirection(d, n); }

FN SurfaceLight rotateLight(SurfaceLight a, real cos2, real sin2) {
  SurfaceLight l;
  l.s0 = a.s0;
  l.s1 = a.s1 * cos2 + a.s2 * sin2;
  l.s2 = a.s2 * cos2 - a.s1 * sin2;
  return l;
}
FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) {
  real cos2;
  real sin2;
  canonicalRotation(d, s, cos2, sin2);
  return rotateLight(p.light, cos2, sin2);
}
FN Payload payloadFromSurface(SurfaceLight l, real3 d, real3 s) {
  real cos2;
  real sin2;
  canonicalRotation(d, s, cos2, sin2);
  Payload p;
  p.light = rotateLight(l, cos2, R(0.0) - sin2);
  return p;
}

FN Payload payloadUnpolarized(real3 radiance) {
  Payload p;
  p.light = lightUnpolarized(radiance);
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) {
  Stokes s;
  s.s0 = p.light.s0;
  s.s1 = p.light.s1;
  s.s2 = p.light.s2;
  s.s3 = splat3(R(0.0));
  return s;
}
