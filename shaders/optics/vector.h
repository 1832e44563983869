// Functions of vectors and numbers, built on math.h alone.

CONST_REAL(kPi, 3.14159265358979323846);

FN real3 select3(mask m, real3 a, real3 b) {
  return make3(selectR(m, a.x, b.x), selectR(m, a.y, b.y), selectR(m, a.z, b.z));
}

FN real3 max3(real3 a, real b) { return make3(maxR(a.x, b), maxR(a.y, b), maxR(a.z, b)); }
FN real3 min3(real3 a, real b) { return make3(minR(a.x, b), minR(a.y, b), minR(a.z, b)); }

// Unit vector along v; v must not be 0.
FN real3 normalize3(real3 v) { return v * (R(1.0) / sqrtR(dot3(v, v))); }

// +1 for x >= 0 and for both zeros, else -1.
FN real signNotZero(real x) { return selectR(lessR(x, R(0.0)), R(-1.0), R(1.0)); }

FN real square(real x) { return x * x; }

// Sizes below it count as 0 before they divide: a device may flush a denormal to 0 in the division, and not in the
// comparison before it.
CONST_REAL(kNegligible, 1e-37);

// Divisor for the size x >= 0: x, or 1 where x is negligible.
FN real divisor(real x) { return selectR(lessR(x, kNegligible), R(1.0), x); }

FN real clampUnit(real x) { return minR(maxR(x, R(0.0)), R(1.0)); }

// e^-x for an optical depth x >= 0: in [0, 1], and 1 at x = 0. The exponential function of a device may miss both by 3
// ulp and more.
FN real attenuation(real x) { return selectR(lessR(R(0.0), x), clampUnit(expR(R(0.0) - x)), R(1.0)); }

// Optical depth -log(y) of a transmittance y in (0, 1]. Near 1, where the logarithm of a device may have an absolute
// error of 2^-21, it is 2 artanh((1 - y)/(1 + y)) by its series to the 13th power, whose relative error is under 1e-19.
FN real opticalDepth(real y) {
  real z = (R(1.0) - y) / (R(1.0) + y);
  real zSq = z * z;
  real tail = R(1.0) + zSq * R(7.0) / R(9.0) * (R(1.0) + zSq * R(9.0) / R(11.0) * (R(1.0) + zSq * R(11.0) / R(13.0)));
  real series =
      R(2.0) * z * (R(1.0) + zSq / R(3.0) * (R(1.0) + zSq * R(3.0) / R(5.0) * (R(1.0) + zSq * R(5.0) / R(7.0) * tail)));
  return selectR(lessR(y, R(0.9)), R(0.0) - logR(y), series);
}

// x^n for 0 <= n < 4096, by squaring: the same on every device, which pow() is not. Its error is at most n roundings,
// as large as the effect of the rounding of x itself.
FN real powInteger(real x, word n) {
  real result = R(1.0);
  real power = x;
  for (int bit = 0; bit < 12; ++bit) {
    result = result * selectR(hasBit(n, bit), power, R(1.0));
    power = power * power;
  }
  return result;
}
