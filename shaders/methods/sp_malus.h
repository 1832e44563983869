// Method `sp-malus`: as `sp`, with powers rotated by Malus's law, cos^2 and sin^2. 36 bytes.

#include "shaders/methods/powers.h"
#include "shaders/methods/s_vector.h"

FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) {
  real along = square(dot3(s, p.sDir));
  real across = square(dot3(s, cross3(d, p.sDir)));
  mask none = equalR(dot3(p.sDir, p.sDir), R(0.0));
  real a = selectR(none, R(1.0), along);
  real b = selectR(none, R(0.0), across);
  SurfaceLight l;
  l.s = p.s * a + p.p * b;
  l.p = p.s * b + p.p * a;
  return l;
}
