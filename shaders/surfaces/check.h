// Check of the light that surfaces send toward the camera (--check-numerics): finite, not negative, at most fully
// polarized. Where kCheckNumerics is false none of it is called.

// A device's own isnan may be optimized away.
FN bool isFinite(real x) {
#ifdef __cplusplus
  return std::isfinite(x);
#else
  return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
#endif
}

// |(s1, s2, s3)| - s0, without squares that overflow.
FN real polarizationExcess(real s0, real s1, real s2, real s3) {
  real m = maxR(absR(s1), maxR(absR(s2), absR(s3)));
  if (m < kNegligible) return R(0.0) - s0;
  real a = s1 / m;
  real b = s2 / m;
  real c = s3 / m;
  return m * sqrtR(a * a + b * b + c * c) - s0;
}

// Amount by which light may exceed full polarization behind the next surface: its present excess and 4 eps of its
// power. Rounding adds up to 2.7 eps per interaction (measured).
FN real3 roundingSlack(Stokes s) {
  real eps = R(8.0) * kUnitRoundoff;
  return make3(maxR(polarizationExcess(s.s0.x, s.s1.x, s.s2.x, s.s3.x), R(0.0)) + eps * absR(s.s0.x),
               maxR(polarizationExcess(s.s0.y, s.s1.y, s.s2.y, s.s3.y), R(0.0)) + eps * absR(s.s0.y),
               maxR(polarizationExcess(s.s0.z, s.s1.z, s.s2.z, s.s3.z), R(0.0)) + eps * absR(s.s0.z));
}

FN void checkColour(IN(Hit) h, real s0, real s1, real s2, real s3, real slack, uint colour) {
  uint kind = kNoFault;
  if (!isFinite(s0) || !isFinite(s1) || !isFinite(s2) || !isFinite(s3))
    kind = kNotFinite;
  else if (s0 < R(0.0) - slack)
    kind = kNegative;
  else if (polarizationExcess(s0, s1, s2, s3) > slack)
    kind = kOverPolarized;
  if (kind == kNoFault) return;
  vec4 s;
  s.x = float(s0);
  s.y = float(s1);
  s.z = float(s2);
  s.w = float(s3);
  noteFault(h, s, kind, colour, float(slack));
}
