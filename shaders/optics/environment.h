// Environment light, without trigonometry.

// Octahedral map of unit vectors onto [0, 1]^2, and its inverse. Source: Cigolle et al., A Survey of Efficient
// Representations for Independent Unit Vectors, JCGT 3(2), 2014.
FN void octahedralFromDirection(real3 d, OUT(real) u, OUT(real) v) {
  real scale = R(1.0) / (absR(d.x) + absR(d.y) + absR(d.z));
  real x = d.x * scale;
  real y = d.y * scale;
  mask lower = lessR(d.z, R(0.0));
  real foldX = (R(1.0) - absR(y)) * signNotZero(x);
  real foldY = (R(1.0) - absR(x)) * signNotZero(y);
  u = R(0.5) + R(0.5) * selectR(lower, foldX, x);
  v = R(0.5) + R(0.5) * selectR(lower, foldY, y);
}

FN real3 directionFromOctahedral(real u, real v) {
  real x = R(2.0) * u - R(1.0);
  real y = R(2.0) * v - R(1.0);
  real z = R(1.0) - absR(x) - absR(y);
  mask lower = lessR(z, R(0.0));
  real unfoldX = (R(1.0) - absR(y)) * signNotZero(x);
  real unfoldY = (R(1.0) - absR(x)) * signNotZero(y);
  return normalize3(make3(selectR(lower, unfoldX, x), selectR(lower, unfoldY, y), z));
}

// Irradiance in W/m^2 of a distant environment on a surface with unit normal n. c0 to c8: coefficients of one colour
// for 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2, multiplied with the factors of the clamped cosine. Source: Ramamoorthi
// and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001.
FN real irradiancePolynomial(real3 n, real c0, real c1, real c2, real c3, real c4, real c5, real c6, real c7, real c8) {
  real linear = c1 * n.y + c2 * n.z + c3 * n.x;
  real mixed = c4 * n.x * n.y + c5 * n.y * n.z + c7 * n.x * n.z;
  real squares = c6 * (R(3.0) * n.z * n.z - R(1.0)) + c8 * (n.x - n.y) * (n.x + n.y);
  return maxR(c0 + linear + mixed + squares, R(0.0));
}

// Solid angle per area of the unit square at direction d, in sr: that of an octahedron's face, 1/|p|^3 for the point p
// of d on it, whose coordinates have the size 2.
FN real octahedralSolidAngle(real3 d) {
  real l = absR(d.x) + absR(d.y) + absR(d.z);
  return R(4.0) * l * l * l;
}

// Direction of the hemisphere about the unit vector n, distributed with the density cosine/pi for u, v in [0, 1).
// Source: Malley's method, as in Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, A.5.3.
FN real3 cosineDirection(real3 n, real u, real v) {
  real3 x;
  real3 y;
  canonicalFrame(n, x, y);
  Complex turn = cisTwoPi(v);
  real radius = sqrtR(u);
  return x * (radius * turn.re) + y * (radius * turn.im) + n * sqrtR(maxR(R(1.0) - u, R(0.0)));
}
