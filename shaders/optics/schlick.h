// Schlick's approximation of the unpolarized reflectance: F0 + (1 - F0)(1 - c)^5. Source: Schlick, An Inexpensive BRDF
// Model for Physically-based Rendering, Computer Graphics Forum 13(3), 1994.
//
// c: cosine of the angle of incidence; n1, n2 - i k2: indices; difference: n2 - n1, as in fresnel.h; f0: reflectance at
// normal incidence; matched: there is no interface, which reflects nothing at every angle. Light that leaves the denser
// dielectric uses the cosine of the transmitted ray; total reflection gives 1.
FN real schlickCurve(real c, real n1, real n2, real k2, real difference, real f0, mask matched) {
  real eta = n2 / n1;
  real transmittedSq = R(1.0) - (R(1.0) - c) * (R(1.0) + c) / (eta * eta);
  mask leaving = andM(lessR(difference, R(0.0)), equalR(k2, R(0.0)));
  real cosine = selectR(leaving, sqrtR(maxR(transmittedSq, R(0.0))), c);
  real m = R(1.0) - cosine;
  real m2 = m * m;
  real curve = f0 + (R(1.0) - f0) * m2 * m2 * m;
  curve = selectR(andM(leaving, lessR(transmittedSq, R(0.0))), R(1.0), curve);
  return selectR(matched, R(0.0), curve);
}
// The same with F0 = |(n2 - i k2 - n1)/(n2 - i k2 + n1)|^2. difference: n2 - n1, as in fresnel.h.
FN real schlickReflectanceWith(real c, real n1, real n2, real k2, real difference) {
  real sum = n2 + n1;
  real contrastSq = difference * difference + k2 * k2;
  real f0 = contrastSq / (sum * sum + k2 * k2);
  return schlickCurve(c, n1, n2, k2, difference, f0, equalR(contrastSq, R(0.0)));
}
FN real schlickReflectance(real c, real n1, real n2, real k2) { return schlickReflectanceWith(c, n1, n2, k2, n2 - n1); }
