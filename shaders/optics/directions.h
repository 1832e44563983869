// Directions of reflected and refracted rays at a smooth interface. d: unit direction of the ray; n: unit normal
// against it (dot(d, n) <= 0); c = -dot(d, n). Results are normalized, so that long chains do not drift.

// Mirror direction d + 2 c n.
FN real3 mirrorDirection(real3 d, real3 n, real c) { return normalize3(d + n * (R(2.0) * c)); }

// Snell's law, from a medium of index n1 into one of index n2: eta d' = d + (c - t) n, with c - t evaluated as
// -(eta^2 - 1)/(c + t). The result has no meaning in total reflection.
FN real3 refractedDirectionFromTerms(real3 d, real3 n, real c, RefractionTerms f) {
  real sum = c + f.t;
  real difference = (R(0.0) - f.etaSqM1) / divisor(sum);
  return normalize3(d + n * selectR(f.matched, R(0.0), difference));
}
FN real3 refractedDirection(real3 d, real3 n, real c, real n1, real n2) {
  return refractedDirectionFromTerms(d, n, c, refractionTerms(c, n1, n2));
}
