// Schlick's approximation of the unpolarized reflectance: F0 + (1 - F0)(1 - c)^5. Source: Schlick, An Inexpensive BRDF
// Model for Physically-based Rendering, Computer Graphics Forum 13(3), 1994.
//
// c: cosine of the angle of incidence; n1, n2 - i k2: indices; f0: reflectance at normal incidence. Light that leaves
// the denser dielectric uses the cosine of the transmitted ray; total reflection gives 1.
FN real schlickCurve(real c, real n1, real n2, real k2, real f0) {
  real eta = n2 / n1;
  real sinSq = (R(1.0) - c) * (R(1.0) + c);
  real transmittedSq = R(1.0) - sinSq / (eta * eta);
  mask leaving = andM(lessR(n2, n1), equalR(k2, R(0.0)));
  real cosine = selectR(leaving, sqrtR(maxR(transmittedSq, R(0.0))), c);
  real m = R(1.0) - cosine;
  real m2 = m * m;
  real f = f0 + (R(1.0) - f0) * m2 * m2 * m;
  return selectR(andM(leaving, lessR(transmittedSq, R(0.0))), R(1.0), f);
}
// The same with F0 = |(n2 - i k2 - n1)/(n2 - i k2 + n1)|^2.
FN real schlickReflectance(real c, real n1, real n2, real k2) {
  real d = n2 - n1;
  real s = n2 + n1;
  return schlickCurve(c, n1, n2, k2, (d * d + k2 * k2) / (s * s + k2 * k2));
}
