// What methods with the exact unpolarized reflectance need of an interface: the mean of R_s and R_p per colour.

struct Factors {
  real3 r;
};

FN real meanReflectance(Reflectance f) { return R(0.5) * (f.rs + f.rp); }

FN Factors dielectricFactors(real c, real n1, real n2) {
  Factors f;
  f.r = splat3(meanReflectance(dielectricReflectance(c, n1, n2)));
  return f;
}
FN Factors conductorFactors(real c, real n1, real3 n2, real3 k2) {
  Factors f;
  f.r = make3(meanReflectance(conductorReflectance(c, n1, n2.x, k2.x)),
              meanReflectance(conductorReflectance(c, n1, n2.y, k2.y)),
              meanReflectance(conductorReflectance(c, n1, n2.z, k2.z)));
  return f;
}
FN real3 meanTransmittance(Factors f) { return splat3(R(1.0)) - f.r; }
