// Method `sp`: section 2 of the paper. A ray returns the powers I_s and I_p and the unit s direction of the surface
// that it hit; the receiving surface rotates them to its s direction with absolute cosines. This rule of the paper
// creates energy, up to a factor of 1.41. 36 bytes. s = 0 marks light without a direction (environment, emitter), which
// counts as I_s = I_p in the receiver's frame.

#include "shaders/methods/powers.h"
#include "shaders/methods/s_vector.h"

FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) {
  real along = absR(dot3(s, p.sDir));
  real across = absR(dot3(s, cross3(d, p.sDir)));
  mask none = equalR(dot3(p.sDir, p.sDir), R(0.0));
  real a = selectR(none, R(1.0), along);
  real b = selectR(none, R(0.0), across);
  SurfaceLight l;
  l.s = p.s * a + p.p * b;
  l.p = p.s * b + p.p * a;
  return l;
}
