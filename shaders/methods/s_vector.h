// The payload of `sp` and `sp-malus`: powers and the s direction as a vector.

CONST int kPayloadBytes = 36;
CONST int kHasStokes = 0;

struct Payload {
  real3 s;
  real3 p;
  real3 sDir;  // unit, or 0: light without a direction
};

FN real payloadDepth(Payload p) { return p.s.x; }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.s.x = depth; }
FN real payloadOriginDistance(Payload p) { return p.s.y; }
FN void payloadSetOriginDistance(INOUT(Payload) p, real distance) { p.s.y = distance; }
FN word payloadPath(Payload p) { return floatBits(p.s.z); }
FN void payloadSetPath(INOUT(Payload) p, word path) { p.s.z = floatValue(path); }

FN Payload payloadUnpolarized(real3 radiance) {
  Payload p;
  p.s = radiance * R(0.5);
  p.p = p.s;
  p.sDir = splat3(R(0.0));
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) { return stokesOfPowers(p.s, p.p, p.sDir, d); }

FN Payload payloadFromSurface(SurfaceLight l, real3 d, real3 s) {
  Payload p;
  p.s = l.s;
  p.p = l.p;
  p.sDir = s;
  return p;
}
