// The s direction as one cosine (methods `sp-cosine` and `sp-ratio`).

FN real cosineFromS(real3 d, real3 s) {
  real3 x;
  real3 y;
  canonicalFrame(d * R(-1.0), x, y);
  real c = dot3(s, x);
  return selectR(lessR(dot3(s, y), R(0.0)), R(0.0) - c, c);
}
// The unit s direction; 0 where the cosine marks light without a direction.
FN real3 sFromCosine(real cosine, real3 d) {
  real3 x;
  real3 y;
  canonicalFrame(d * R(-1.0), x, y);
  mask none = lessR(R(1.5), cosine);
  real c = minR(cosine, R(1.0));
  real s = sqrtR(maxR((R(1.0) - c) * (R(1.0) + c), R(0.0)));
  return select3(none, splat3(R(0.0)), x * c + y * s);
}
// The paper's absolute-cosine rule.
FN SurfaceLight receivePowers(real3 inS, real3 inP, real cosine, real3 d, real3 s) {
  real3 sIn = sFromCosine(cosine, d);
  mask none = lessR(R(1.5), cosine);
  real a = selectR(none, R(1.0), absR(dot3(s, sIn)));
  real b = selectR(none, R(0.0), absR(dot3(s, cross3(d, sIn))));
  SurfaceLight l;
  l.s = inS * a + inP * b;
  l.p = inS * b + inP * a;
  return l;
}
