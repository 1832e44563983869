// Method `sp-ratio`: section 3.2 of the paper. As `sp-cosine`, with I_p stored as one number for all colours,
// ratio = sum I_p / sum I_s. If the sum of I_s is at most 1e-20 of that of I_p, or negligible, the powers are exchanged
// so that no light is lost: I_p is stored as I_s, the ratio is 0, and the cosine is that of the p direction, 90 degrees
// away. 20 bytes.

#include "shaders/methods/powers.h"

CONST int kPayloadBytes = 20;
CONST int kHasStokes = 0;

struct Payload {
  real3 s;
  real ratio;
  real cosine;
};

FN real payloadDepth(Payload p) { return p.s.x; }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.s.x = depth; }
FN real payloadOriginDistance(Payload p) { return p.s.y; }
FN void payloadSetOriginDistance(INOUT(Payload) p, real distance) { p.s.y = distance; }
FN word payloadPath(Payload p) { return floatBits(p.s.z); }
FN void payloadSetPath(INOUT(Payload) p, word path) { p.s.z = floatValue(path); }

#include "shaders/methods/s_cosine.h"

FN Payload payloadUnpolarized(real3 radiance) {
  Payload p;
  p.s = radiance * R(0.5);
  p.ratio = R(1.0);
  p.cosine = R(2.0);
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) { return stokesOfPowers(p.s, p.s * p.ratio, sFromCosine(p.cosine, d), d); }

FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) {
  return receivePowers(p.s, p.s * p.ratio, p.cosine, d, s);
}

FN Payload payloadFromSurface(SurfaceLight l, real3 d, real3 s) {
  real sumS = l.s.x + l.s.y + l.s.z;
  real sumP = l.p.x + l.p.y + l.p.z;
  mask dark = lessEqualR(sumS, maxR(sumP * R(1e-20), kNegligible));
  // A direction at 90 degrees to (c, +sqrt(1 - c^2)), its y not negative: (-sign(c) sqrt(1 - c^2), |c|).
  real c = cosineFromS(d, s);
  real across = R(0.0) - signNotZero(c) * sqrtR(maxR((R(1.0) - c) * (R(1.0) + c), R(0.0)));
  Payload p;
  p.s = select3(dark, l.p, l.s);
  p.ratio = selectR(dark, R(0.0), sumP / selectR(dark, R(1.0), sumS));
  p.cosine = selectR(dark, across, c);
  return p;
}
