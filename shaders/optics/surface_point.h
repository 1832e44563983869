// Where a ray meets a triangle: the normal to shade with, and origins of further rays.

// Normal to shade with, against the ray. geometric: unit normal of the face; interpolated: of the
// vertices, any length but 0, on the same side. Both are turned against d; where the interpolated one
// then faces away from the ray, or sends the mirror direction below the face, the geometric one is taken.
FN real3 shadingNormal(real3 d, real3 geometric, real3 interpolated) {
  real side = R(0.0) - signNotZero(dot3(d, geometric));
  real3 g = geometric * side;
  real3 n = normalize3(interpolated) * side;
  real c = R(0.0) - dot3(d, n);
  real3 mirror = d + n * (R(2.0) * c);
  mask usable = andM(lessR(R(0.0), c), lessR(R(0.0), dot3(mirror, g)));
  return select3(usable, n, g);
}

// Bound on the rounding error of a point b0 p0 + b1 p1 + b2 p2 per axis: gamma(7) times the sum of
// absolute terms, gamma(n) = n u/(1 - n u), u the unit roundoff. Source: Pharr, Jakob and Humphreys,
// Physically Based Rendering, 4th edition, 6.8.5.
FN real3 hitPointError(real3 p0, real3 p1, real3 p2, real b0, real b1, real b2, real unitRoundoff) {
  real gamma7 = R(7.0) * unitRoundoff / (R(1.0) - R(7.0) * unitRoundoff);
  return make3((absR(b0 * p0.x) + absR(b1 * p1.x) + absR(b2 * p2.x)) * gamma7,
               (absR(b0 * p0.y) + absR(b1 * p1.y) + absR(b2 * p2.y)) * gamma7,
               (absR(b0 * p0.z) + absR(b1 * p1.z) + absR(b2 * p2.z)) * gamma7);
}

FN real largestPart(real3 v) { return maxR(absR(v.x), maxR(absR(v.y), absR(v.z))); }

// Distance at which an intersector may still find the triangle that a ray leaves: it subtracts the origin
// from the corners and multiplies the differences, so its error grows with the triangle and not with the
// point: 8 roundings of the largest difference. Measured on lavapipe, whose floors show their own triangle
// at 1 and at 2 no more; Embree needs none.
FN real intersectionError(real3 p0, real3 p1, real3 p2, real3 p, real unitRoundoff) {
  return R(8.0) * unitRoundoff * maxR(largestPart(p0 - p), maxR(largestPart(p1 - p), largestPart(p2 - p)));
}

// p, moved away from the nearest edge, within the face, until it is four times its error off or half way across. A
// ray from an edge would start on the neighbour's plane, where rounding lets it start behind and leak. across: cross
// product of p1 - p0 and p2 - p0.
FN real3 insideTriangle(real3 p, real3 p0, real3 p1, real3 p2, real b0, real b1, real b2, real3 across, real3 error) {
  real3 e0 = p2 - p1;
  real3 e1 = p0 - p2;
  real3 e2 = p1 - p0;
  // Distance from the edge opposite a corner: its barycentric coordinate times 2 A/|edge|.
  real c0 = maxR(b0, R(0.0));
  real c1 = maxR(b1, R(0.0));
  real c2 = maxR(b2, R(0.0));
  real q0 = c0 * c0 / maxR(dot3(e0, e0), R(1e-37));
  real q1 = c1 * c1 / maxR(dot3(e1, e1), R(1e-37));
  real q2 = c2 * c2 / maxR(dot3(e2, e2), R(1e-37));
  mask first = andM(lessEqualR(q0, q1), lessEqualR(q0, q2));
  mask second = lessEqualR(q1, q2);
  real3 edge = select3(first, e0, select3(second, e1, e2));
  real c = selectR(first, c0, selectR(second, c1, c2));
  real length = sqrtR(dot3(edge, edge));
  real area = sqrtR(dot3(across, across));
  mask none = orM(lessEqualR(length, R(0.0)), lessEqualR(area, R(0.0)));
  real height = area / selectR(none, R(1.0), length);
  real off = maxR(minR(R(4.0) * largestPart(error), R(0.5) * height) - c * height, R(0.0));
  return p + cross3(across, edge) * (selectR(none, R(0.0), off) / selectR(none, R(1.0), length * area));
}

// Origin of a ray that leaves p on the side that n points to, off the box of size error about p, and one
// rounding step further. n is the unit face normal, turned to the side that the ray leaves to. Source: as
// above, 6.8.6.
FN real3 rayOrigin(real3 p, real3 error, real3 n, real unitRoundoff) {
  real distance = dot3(error, make3(absR(n.x), absR(n.y), absR(n.z)));
  real3 o = p + n * distance;
  real step = R(2.0) * unitRoundoff;
  return make3(o.x + signNotZero(n.x) * absR(o.x) * step, o.y + signNotZero(n.y) * absR(o.y) * step,
               o.z + signNotZero(n.z) * absR(o.z) * step);
}
