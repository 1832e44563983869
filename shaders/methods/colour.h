// Shared by the methods that carry one colour (schlick, fresnel): light has no direction across the ray. Included after
// their FresnelTerms.

FN real payloadDepth(Payload p) { return p.colour.x; }
FN void payloadSetDepth(INOUT(Payload) p, real depth) { p.colour.x = depth; }
FN real payloadOriginDistance(Payload p) { return p.colour.y; }
FN void payloadSetOriginDistance(INOUT(Payload) p, real distance) { p.colour.y = distance; }
FN word payloadPath(Payload p) { return floatBits(p.colour.z); }
FN void payloadSetPath(INOUT(Payload) p, word path) { p.colour.z = floatValue(path); }

// Unused: light has no direction across the ray.
FN real3 surfaceS(real3 d, real3 n) { return n; }

FN Payload payloadUnpolarized(real3 radiance) {
  Payload p;
  p.colour = radiance;
  return p;
}
FN Stokes payloadStokes(Payload p, real3 d) { return stokesUnpolarized(p.colour); }

FN SurfaceLight lightUnpolarized(real3 radiance) {
  SurfaceLight l;
  l.colour = radiance;
  return l;
}
FN SurfaceLight lightPolarized(real3 radiance, real degree) { return lightUnpolarized(radiance); }
FN SurfaceLight lightFromStokes(Stokes s) { return lightUnpolarized(s.s0); }
FN real3 lightRadiance(SurfaceLight l) { return l.colour; }
FN SurfaceLight lightScale(SurfaceLight a, real3 scale) {
  SurfaceLight l;
  l.colour = a.colour * scale;
  return l;
}
FN SurfaceLight lightAdd(SurfaceLight a, SurfaceLight b) {
  SurfaceLight l;
  l.colour = a.colour + b.colour;
  return l;
}
FN SurfaceLight lightAtSurface(Payload p, real3 d, real3 s) {
  SurfaceLight l;
  l.colour = p.colour;
  return l;
}
FN Payload payloadFromSurface(SurfaceLight l, real3 d, real3 s) {
  Payload p;
  p.colour = l.colour;
  return p;
}
FN SurfaceLight lightThroughInterface(FresnelTerms f, SurfaceLight l) {
  SurfaceLight r;
  r.colour = f.r * l.colour;
  return r;
}
// Diffuse light that leaves through the interface.
FN SurfaceLight lightFromBelow(FresnelTerms f, real3 radiance) {
  return lightThroughInterface(transmissionTerms(f), lightUnpolarized(radiance));
}
