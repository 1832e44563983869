// Where light goes at a smooth interface. d: unit direction of the ray, n: unit normal against it
// (dot(d, n) <= 0), c = -dot(d, n). The results are normalized so that long chains do not drift.

FN real3 mirrorDirection(real3 d, real3 n, real c) { return normalize3(d + n * (R(2.0) * c)); }

// Snell's law; c - t is taken as -(eta^2 - 1)/(c + t). In total reflection the result is not used.
FN real3 refractedDirection(real3 d, real3 n, real c, real n1, real n2) {
  RefractionTerms f = refractionTerms(c, n1, n2);
  real sum = c + f.t;
  real difference = (R(0.0) - f.etaSqM1) / selectR(equalR(sum, R(0.0)), R(1.0), sum);
  return normalize3(d + n * selectR(f.matched, R(0.0), difference));
}
