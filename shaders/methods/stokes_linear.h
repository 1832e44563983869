// Method `stokes-linear`: S0 to S2 per colour in the ray's canonical frame; circular light is dropped at
// every surface. Exact where no circular light matters. 36 bytes.

#include "shaders/methods/mueller.h"

CONST int kPayloadBytes = 36;
CONST int kHasStokes = 1;

struct Payload {
  real3 s0;
  real3 s1;
  real3 s2;
};

FN real payloadDepth(Payload p) { return p.s0.x; }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.s0.x = depth; }

FN Payload payloadSource(real3 radiance) {
  Payload p;
  p.s0 = radiance;
  p.s1 = splat3(R(0.0));
  p.s2 = splat3(R(0.0));
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) {
  Stokes s;
  s.s0 = p.s0;
  s.s1 = p.s1;
  s.s2 = p.s2;
  s.s3 = splat3(R(0.0));
  return s;
}

FN Light lightReceive(Payload p, real3 d, real3 s) {
  Light l;
  l.stokes = stokesToSurface(payloadStokes(p, d), d, s);
  return l;
}
FN Payload payloadSend(Light l, real3 d, real3 s) {
  Stokes sent = stokesFromSurface(l.stokes, d, s);
  Payload p;
  p.s0 = sent.s0;
  p.s1 = sent.s1;
  p.s2 = sent.s2;
  return p;
}
