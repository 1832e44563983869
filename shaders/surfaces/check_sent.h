// Check of the light that a surface of a recursive method sends (check.h).

// arriving: slack of the light that arrived at the surface.
FN void checkSent(IN(Hit) h, Payload sent, real3 arriving) {
  Stokes s = payloadStokes(sent, h.d);
  real eps = R(8.0) * kUnitRoundoff;
  checkColour(h, s.s0.x, s.s1.x, s.s2.x, s.s3.x, arriving.x + eps * absR(s.s0.x), 0u);
  checkColour(h, s.s0.y, s.s1.y, s.s2.y, s.s3.y, arriving.y + eps * absR(s.s0.y), 1u);
  checkColour(h, s.s0.z, s.s1.z, s.s2.z, s.s3.z, arriving.z + eps * absR(s.s0.z), 2u);
}
