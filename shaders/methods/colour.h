// What the methods that carry one colour (schlick, fresnel) share: light is a colour, and no direction
// across the ray means anything. Included after their Factors.

FN real payloadDepth(Payload p) { return p.colour.x; }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.colour.x = depth; }

// No direction across the ray means anything.
FN real3 surfaceS(real3 d, real3 n) { return n; }

FN Payload payloadSource(real3 radiance) {
  Payload p;
  p.colour = radiance;
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) { return stokesUnpolarized(p.colour); }

FN Light lightUnpolarized(real3 radiance) {
  Light l;
  l.colour = radiance;
  return l;
}
FN Light lightPolarized(real3 radiance, real degree) { return lightUnpolarized(radiance); }
FN Light lightScale(Light a, real3 scale) {
  Light l;
  l.colour = a.colour * scale;
  return l;
}
FN Light lightAdd(Light a, Light b) {
  Light l;
  l.colour = a.colour + b.colour;
  return l;
}
FN Light lightReceive(Payload p, real3 d, real3 s) {
  Light l;
  l.colour = p.colour;
  return l;
}
FN Payload payloadSend(Light l, real3 d, real3 s) {
  Payload p;
  p.colour = l.colour;
  return p;
}
FN Light lightReflect(Factors f, Light l) {
  Light r;
  r.colour = f.r * l.colour;
  return r;
}
FN Light lightTransmit(Factors f, Light l) {
  Light r;
  r.colour = (splat3(R(1.0)) - f.r) * l.colour;
  return r;
}
// Diffuse light that leaves through the interface.
FN Light lightLeave(Factors f, real3 radiance) { return lightTransmit(f, lightUnpolarized(radiance)); }
