// Angles without a trigonometric function of a library, whose error on devices would be visible.

// Angle in [0, pi] between the x axis and the point (x, y), y >= 0, not both 0: by three halvings, which leave a
// tangent of at most 0.199, and the Taylor series up to the 19th power. Relative error of a few roundings, 1e-15 in
// double.
FN real angleOfPoint(real x, real y) {
  real t = y / divisor(sqrtR(x * x + y * y) + absR(x));
  t = t / (R(1.0) + sqrtR(R(1.0) + t * t));
  t = t / (R(1.0) + sqrtR(R(1.0) + t * t));
  real s = t * t;
  real tail = R(1.0) / R(13.0) - s * (R(1.0) / R(15.0) - s * (R(1.0) / R(17.0) - s / R(19.0)));
  real series =
      R(1.0) -
      s * (R(1.0) / R(3.0) -
           s * (R(1.0) / R(5.0) - s * (R(1.0) / R(7.0) - s * (R(1.0) / R(9.0) - s * (R(1.0) / R(11.0) - s * tail)))));
  real angle = R(8.0) * t * series;
  return selectR(lessR(x, R(0.0)), kPi - angle, angle);
}

// Angle in [-pi/2, pi/2] whose sine is x, |x| <= 1.
FN real arcSine(real x) {
  real angle = angleOfPoint(sqrtR(maxR((R(1.0) - x) * (R(1.0) + x), R(0.0))), absR(x));
  return angle * signNotZero(x);
}

// Cosine and sine of an angle in radians.
FN Complex cis(real angle) { return cisTwoPi(angle * (R(0.5) / kPi)); }
