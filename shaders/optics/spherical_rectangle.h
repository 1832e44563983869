// Points of a rectangle whose directions are distributed uniformly over the solid angle that it subtends. Source:
// Urena, Fajardo and King, An Area-Preserving Parametrization for Spherical Rectangles, Computer Graphics Forum 32(4),
// 2013 (EGSR). With n_i the z component of the normal of the plane through the point and side i, the angle of a corner
// is pi/2 + asin(n_i n_(i+1)): the sum of the arc sines replaces that of the angles minus 2 pi.

// Sine of the angle between the z axis and the plane through a side at distance `offset` from the axis, z away.
FN real sideSine(real offset, real z) { return offset / divisor(sqrtR(offset * offset + z * z)); }

// Offsets along the unit axes x and y of the rectangle's sides from the foot of the point, in which z > 0 is the
// distance from the rectangle's plane; u, v in [0, 1). solidAngle: of the rectangle.
FN void sampleSphericalRectangle(real x0, real x1, real y0, real y1, real z, real solidAngle, real u, real v,
                                 OUT(real) x, OUT(real) y) {
  real n0 = R(0.0) - sideSine(y0, z);
  real n2 = sideSine(y1, z);
  real n3 = R(0.0) - sideSine(x0, z);
  // The side of constant x that bounds the share u.
  Complex angle = cis(u * solidAngle - arcSine(n2 * n3) - arcSine(n3 * n0));
  real rise = angle.re * n0 + n2;
  real slopeSq = z * z / divisor(z * z + y0 * y0);
  real below = sqrtR(maxR(rise * rise - slopeSq * angle.im * angle.im, R(0.0)));
  // The limits cut off a quotient beyond the rectangle, which is infinite or rounding error.
  real numerator = z * absR(angle.im);
  real size = maxR(absR(x0), absR(x1));
  real reach = numerator / divisor(maxR(below, R(0.5) * numerator / divisor(size)));
  x = minR(maxR(reach * signNotZero(rise) * signNotZero(angle.im), x0), x1);
  // Along it, the sine of the angle from the plane y = 0 is distributed uniformly.
  real distanceSq = x * x + z * z;
  real h0 = y0 / divisor(sqrtR(distanceSq + y0 * y0));
  real h1 = y1 / divisor(sqrtR(distanceSq + y1 * y1));
  real h = h0 + v * (h1 - h0);
  real c = sqrtR(maxR((R(1.0) - h) * (R(1.0) + h), R(0.0)));
  y = minR(maxR(h * sqrtR(distanceSq) / maxR(c, R(1e-12)), y0), y1);
}
