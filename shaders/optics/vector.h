// Functions of vectors and numbers, built on math.h alone.

CONST real kPi = R(3.14159265358979323846);

FN real3 select3(mask m, real3 a, real3 b) {
  return make3(selectR(m, a.x, b.x), selectR(m, a.y, b.y), selectR(m, a.z, b.z));
}

FN real3 max3(real3 a, real b) { return make3(maxR(a.x, b), maxR(a.y, b), maxR(a.z, b)); }

// Unit vector along v; v must not be 0.
FN real3 normalize3(real3 v) { return v * (R(1.0) / sqrtR(dot3(v, v))); }

// +1 for x >= 0 and for both zeros, else -1.
FN real signNotZero(real x) { return selectR(lessR(x, R(0.0)), R(-1.0), R(1.0)); }

FN real square(real x) { return x * x; }

FN real clampUnit(real x) { return minR(maxR(x, R(0.0)), R(1.0)); }

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
