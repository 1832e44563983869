// Method `sp-cosine`: section 3.1 of the paper. As `sp`, with the s direction stored as one number: the cosine
// between s and the canonical x of the ray, s taken modulo sign so that its y is not negative. The sine
// comes from (1 - c)(1 + c), the best that a cosine near 1 allows: one float step there rotates s by
// up to 3.5e-4 rad. 28 bytes. A cosine of 2 marks light without a direction.

#include "shaders/methods/powers.h"

CONST int kPayloadBytes = 28;
CONST int kHasStokes = 0;

struct Payload {
  real3 s;
  real3 p;
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
  p.p = p.s;
  p.cosine = R(2.0);
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) { return stokesOfPowers(p.s, p.p, sFromCosine(p.cosine, d), d); }

FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) { return receivePowers(p.s, p.p, p.cosine, d, s); }

FN Payload payloadFromSurface(SurfaceLight l, real3 d, real3 s) {
  Payload p;
  p.s = l.s;
  p.p = l.p;
  p.cosine = cosineFromS(d, s);
  return p;
}
