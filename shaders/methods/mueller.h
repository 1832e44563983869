// Factors and light of the methods that carry Stokes vectors: light about to meet, or leaving, a surface
// is a Stokes vector in the surface's frame (x = s). A ray carries it in its canonical frame.

struct Factors {
  real3 rs;
  real3 rp;
  real3 xRe;
  real3 xIm;
  real3 tx;  // sqrt(T_s T_p) of a dielectric, 0 for a conductor
};
struct Light {
  Stokes stokes;
};

FN Factors dielectricFactors(real c, real n1, real n2) {
  Reflectance r = dielectricReflectance(c, n1, n2);
  Transmittance t = dielectricTransmittance(c, n1, n2);
  Factors f;
  f.rs = splat3(r.rs);
  f.rp = splat3(r.rp);
  f.xRe = splat3(r.xRe);
  f.xIm = splat3(r.xIm);
  f.tx = splat3(t.x);
  return f;
}
FN Factors conductorFactors(real c, real n1, real3 n2, real3 k2) {
  Reflectance x = conductorReflectance(c, n1, n2.x, k2.x);
  Reflectance y = conductorReflectance(c, n1, n2.y, k2.y);
  Reflectance z = conductorReflectance(c, n1, n2.z, k2.z);
  Factors f;
  f.rs = make3(x.rs, y.rs, z.rs);
  f.rp = make3(x.rp, y.rp, z.rp);
  f.xRe = make3(x.xRe, y.xRe, z.xRe);
  f.xIm = make3(x.xIm, y.xIm, z.xIm);
  f.tx = splat3(R(0.0));
  return f;
}
FN real3 meanTransmittance(Factors f) { return splat3(R(1.0)) - (f.rs + f.rp) * R(0.5); }

FN Light lightUnpolarized(real3 radiance) {
  Light l;
  l.stokes = stokesUnpolarized(radiance);
  return l;
}
FN Light lightAdd(Light a, Light b) {
  Light l;
  l.stokes = stokesAdd(a.stokes, b.stokes);
  return l;
}
FN Light lightReflect(Factors f, Light l) {
  Light r;
  r.stokes = stokesInterface(l.stokes, f.rs, f.rp, f.xRe, f.xIm);
  return r;
}
FN Light lightTransmit(Factors f, Light l) {
  Light r;
  r.stokes = stokesInterface(l.stokes, splat3(R(1.0)) - f.rs, splat3(R(1.0)) - f.rp, f.tx, splat3(R(0.0)));
  return r;
}
FN Light lightLeave(Factors f, real3 radiance) { return lightTransmit(f, lightUnpolarized(radiance)); }

FN real3 surfaceS(real3 d, real3 n) { return sDirection(d, n); }

// From the canonical frame of a ray in direction d to the frame of a surface with s direction s, and back.
FN Stokes stokesToSurface(Stokes a, real3 d, real3 s) {
  real3 x;
  real3 y;
  real cos2;
  real sin2;
  canonicalFrame(d * R(-1.0), x, y);
  turnTo(s, x, y, cos2, sin2);
  return stokesTurn(a, cos2, sin2);
}
FN Stokes stokesFromSurface(Stokes a, real3 d, real3 s) {
  real3 x;
  real3 y;
  real cos2;
  real sin2;
  canonicalFrame(d * R(-1.0), x, y);
  turnTo(s, x, y, cos2, sin2);
  return stokesTurn(a, cos2, R(0.0) - sin2);
}
