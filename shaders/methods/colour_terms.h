// FresnelTerms of the methods that carry one colour: the reflectance R per colour, and the transmittance T = 1 - R.

struct FresnelTerms {
  real3 r;
};

FN FresnelTerms selectTerms(mask m, FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.r = select3(m, a.r, b.r);
  return f;
}
// Of two shares of a surface: at most 1.
FN FresnelTerms addTerms(FresnelTerms a, FresnelTerms b) {
  FresnelTerms f;
  f.r = min3(a.r + b.r, R(1.0));
  return f;
}
FN FresnelTerms scaleTerms(FresnelTerms a, real3 scale) {
  FresnelTerms f;
  f.r = a.r * scale;
  return f;
}
FN FresnelTerms transmissionTerms(FresnelTerms reflection) {
  FresnelTerms f;
  f.r = splat3(R(1.0)) - reflection.r;
  return f;
}
FN real3 meanTransmittance(FresnelTerms f) { return splat3(R(1.0)) - f.r; }
FN real3 transmittanceDifference(FresnelTerms f) { return splat3(R(0.0)); }
