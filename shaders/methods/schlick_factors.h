// What methods with Schlick's approximation need of an interface: its reflectance per colour.

struct Factors {
  real3 r;
};

FN Factors dielectricFactors(real c, real n1, real n2) {
  Factors f;
  f.r = splat3(schlickReflectance(c, n1, n2, R(0.0)));
  return f;
}
FN Factors conductorFactors(real c, real n1, real3 n2, real3 k2) {
  Factors f;
  f.r = make3(schlickReflectance(c, n1, n2.x, k2.x), schlickReflectance(c, n1, n2.y, k2.y),
              schlickReflectance(c, n1, n2.z, k2.z));
  return f;
}
FN real3 meanTransmittance(Factors f) { return splat3(R(1.0)) - f.r; }
