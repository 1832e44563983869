// What methods with Stokes vectors, and importance rows, need of an interface, per colour. Transmission follows from
// reflection: T_s, T_p = 1 - R_s, 1 - R_p and, on S2 and S3, the root of their product.

struct Factors {
  real3 rs;
  real3 rp;
  real3 xRe;
  real3 xIm;
};

FN Factors dielectricFactors(real c, real n1, real n2) {
  Reflectance r = dielectricReflectance(c, n1, n2);
  Factors f;
  f.rs = splat3(r.rs);
  f.rp = splat3(r.rp);
  f.xRe = splat3(r.xRe);
  f.xIm = splat3(r.xIm);
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
  return f;
}
FN real3 meanTransmittance(Factors f) { return splat3(R(1.0)) - (f.rs + f.rp) * R(0.5); }
