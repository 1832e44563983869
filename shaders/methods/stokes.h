// Method `stokes`: full Stokes vectors per colour in the ray's canonical frame. 48 bytes.

#include "shaders/methods/mueller.h"

CONST int kPayloadBytes = 48;
CONST int kHasStokes = 1;

struct Payload {
  Stokes stokes;
};

FN real payloadDepth(Payload p) { return p.stokes.s0.x; }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.stokes.s0.x = depth; }
FN real payloadOriginDistance(Payload p) { return p.stokes.s0.y; }
FN void payloadSetOriginDistance(INOUT(Payload) p, real distance) { p.stokes.s0.y = distance; }
FN word payloadPath(Payload p) { return floatBits(p.stokes.s0.z); }
FN void payloadSetPath(INOUT(Payload) p, word path) { p.stokes.s0.z = floatValue(path); }

FN Payload payloadUnpolarized(real3 radiance) {
  Payload p;
  p.stokes = stokesUnpolarized(radiance);
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) { return p.stokes; }

FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) {
  SurfaceLight l;
  l.stokes = stokesToSurface(p.stokes, d, s);
  return l;
}
FN Payload payloadFromSurface(SurfaceLight l, real3 d, real3 s) {
  Payload p;
  p.stokes = stokesFromSurface(l.stokes, d, s);
  return p;
}
