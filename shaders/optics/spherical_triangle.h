// Solid angle of a triangle, and directions to it that are distributed uniformly over that solid angle.

struct SphericalTriangle {
  real3 a;  // unit directions to the corners
  real3 b;
  real3 c;
  real solidAngle;  // in sr, in [0, 2 pi)
};

// The triangle with a corner at `corner` from the point and the edges edgeU and edgeV from there. across: cross product
// of the edges. tan(solidAngle/2) = |a b c| / (1 + a.b + b.c + c.a); the determinant is that of the edges, so that a
// tiny solid angle has the relative precision of a large one. Source: van Oosterom and Strackee, The Solid Angle of a
// Plane Triangle, IEEE Trans. Biomed. Eng. 30(2), 1983.
FN SphericalTriangle sphericalTriangle(real3 corner, real3 edgeU, real3 edgeV, real3 across) {
  real3 second = corner + edgeU;
  real3 third = corner + edgeV;
  real inverseA = R(1.0) / divisor(sqrtR(dot3(corner, corner)));
  real inverseB = R(1.0) / divisor(sqrtR(dot3(second, second)));
  real inverseC = R(1.0) / divisor(sqrtR(dot3(third, third)));
  SphericalTriangle t;
  t.a = corner * inverseA;
  t.b = second * inverseB;
  t.c = third * inverseC;
  real volume = absR(dot3(corner, across)) * inverseA * inverseB * inverseC;
  t.solidAngle = R(2.0) * angleOfPoint(R(1.0) + dot3(t.a, t.b) + dot3(t.b, t.c) + dot3(t.c, t.a), volume);
  return t;
}

// Unit direction for u, v in [0, 1): uniform for uniform u and v. The side from a to c ends where the triangle that it
// bounds with b has the share u of the solid angle, and the direction is on the arc from b to that end. Source: Arvo,
// Stratified Sampling of Spherical Triangles, SIGGRAPH 1995. The end follows from its half angle x from a,
//   tan x = sin h |a + b|^2/2 / (|a b d| cos h - b.d sin h), h = u solidAngle/2, d the tangent at a toward c,
// which is the formula of van Oosterom and Strackee for the part, solved for x; differences of directions replace
// 1 - cosine.
FN real3 sampleSphericalTriangle(SphericalTriangle t, real u, real v) {
  real3 step = t.c - t.a;
  real3 d = step - t.a * dot3(t.a, step);
  d = d * (R(1.0) / divisor(sqrtR(dot3(d, d))));
  Complex turn = cis(u * t.solidAngle * R(0.5));
  real3 sum = t.a + t.b;
  real p = absR(dot3(t.a, cross3(t.b, d))) * turn.re - dot3(t.b, d) * turn.im;
  real q = R(0.5) * dot3(sum, sum) * turn.im;
  real scale = R(1.0) / divisor(p * p + q * q);
  real3 end = t.a * ((p - q) * (p + q) * scale) + d * (R(2.0) * p * q * scale);
  // On the arc from b to the end, 1 - cosine from b is v times that of the end.
  real3 way = end - t.b;
  real versine = R(0.5) * dot3(way, way);
  real3 tangent = way + t.b * versine;
  tangent = tangent * (R(1.0) / divisor(sqrtR(dot3(tangent, tangent))));
  real part = v * versine;
  return t.b * (R(1.0) - part) + tangent * sqrtR(maxR(part * (R(2.0) - part), R(0.0)));
}
