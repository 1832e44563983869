// Method `stokes-half`: full Stokes vectors per colour, 16 bits per number. sqrt(S0) is a half float: S0 up to
// 4.3e9, saturating, to 1 part in 1000. S1, S2, S3 are relative to S0, in steps of 1/32767; values that
// rounding raises above full polarization are scaled back to it. 24 bytes.

#include "shaders/methods/mueller.h"

CONST int kPayloadBytes = 24;
CONST int kHasStokes = 1;

// Each word contains two numbers of 16 bits. The twelve numbers: roots of S0 (r, g, b), then s1, s2, s3 of r, of
// g and of b.
struct Payload {
  word rootRg;
  word rootBs1R;
  word s23R;
  word s12G;
  word s3Gs1B;
  word s23B;
};

// In quarters: a depth has a fraction behind a rough surface (surfaces/facet.h).
FN real payloadDepth(Payload p) { return realOfWord(p.rootRg) * R(0.25); }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.rootRg = wordOfReal(depth * R(4.0)); }
FN real payloadOriginDistance(Payload p) { return floatValue(p.rootBs1R); }
FN void payloadSetOriginDistance(INOUT(Payload) p, real distance) { p.rootBs1R = floatBits(distance); }
FN word payloadPath(Payload p) { return p.s23R; }
FN void payloadSetPath(INOUT(Payload) p, word path) { p.s23R = path; }

FN real amplitude(real s0) { return minR(sqrtR(maxR(s0, R(0.0))), R(65504.0)); }
FN real relative(real s, real s0) {
  mask dark = lessR(s0, kNegligible);
  return maxR(minR(selectR(dark, R(0.0), s / selectR(dark, R(1.0), s0)), R(1.0)), R(-1.0));
}

FN Payload packStokes(Stokes s) {
  Payload p;
  p.rootRg = joinWord(halfBits(amplitude(s.s0.x)), halfBits(amplitude(s.s0.y)));
  p.rootBs1R = joinWord(halfBits(amplitude(s.s0.z)), fractionBits(relative(s.s1.x, s.s0.x)));
  p.s23R = joinWord(fractionBits(relative(s.s2.x, s.s0.x)), fractionBits(relative(s.s3.x, s.s0.x)));
  p.s12G = joinWord(fractionBits(relative(s.s1.y, s.s0.y)), fractionBits(relative(s.s2.y, s.s0.y)));
  p.s3Gs1B = joinWord(fractionBits(relative(s.s3.y, s.s0.y)), fractionBits(relative(s.s1.z, s.s0.z)));
  p.s23B = joinWord(fractionBits(relative(s.s2.z, s.s0.z)), fractionBits(relative(s.s3.z, s.s0.z)));
  return p;
}

FN Stokes unpackStokes(Payload p) {
  Stokes s;
  real r = halfValue(lowHalf(p.rootRg));
  real g = halfValue(highHalf(p.rootRg));
  real b = halfValue(lowHalf(p.rootBs1R));
  s.s0 = make3(r * r, g * g, b * b);
  s.s1 = make3(fractionValue(highHalf(p.rootBs1R)), fractionValue(lowHalf(p.s12G)), fractionValue(highHalf(p.s3Gs1B)));
  s.s2 = make3(fractionValue(lowHalf(p.s23R)), fractionValue(highHalf(p.s12G)), fractionValue(lowHalf(p.s23B)));
  s.s3 = make3(fractionValue(highHalf(p.s23R)), fractionValue(lowHalf(p.s3Gs1B)), fractionValue(highHalf(p.s23B)));
  real3 norm = s.s1 * s.s1 + s.s2 * s.s2 + s.s3 * s.s3;
  real3 scale = make3(s.s0.x / sqrtR(maxR(norm.x, R(1.0))), s.s0.y / sqrtR(maxR(norm.y, R(1.0))),
                      s.s0.z / sqrtR(maxR(norm.z, R(1.0))));
  s.s1 = s.s1 * scale;
  s.s2 = s.s2 * scale;
  s.s3 = s.s3 * scale;
  return s;
}

FN Payload payloadUnpolarized(real3 radiance) { return packStokes(stokesUnpolarized(radiance)); }
FN Stokes payloadStokes(Payload p, real3 d) { return unpackStokes(p); }

FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) {
  SurfaceLight l;
  l.stokes = stokesToSurface(unpackStokes(p), d, s);
  return l;
}
FN Payload payloadFromSurface(SurfaceLight l, real3 d, real3 s) {
  return packStokes(stokesFromSurface(l.stokes, d, s));
}
