// Hit point of a ray and a triangle: shading normal and origins of further rays. Lengths are in metres.

// Shading normal, against the ray. geometric: unit normal of the face; interpolated: interpolated normal of the
// vertices, on the same side, of any length but 0. Both are flipped against d. The geometric normal replaces an
// interpolated one that then faces away from the ray or reflects it below the face.
FN real3 shadingNormal(real3 d, real3 geometric, real3 interpolated) {
  real side = R(0.0) - signNotZero(dot3(d, geometric));
  real3 g = geometric * side;
  real3 n = normalize3(interpolated) * side;
  real c = R(0.0) - dot3(d, n);
  real3 mirror = d + n * (R(2.0) * c);
  mask usable = andM(lessR(R(0.0), c), lessR(R(0.0), dot3(mirror, g)));
  return select3(usable, n, g);
}

// Largest absolute component.
FN real largestPart(real3 v) { return maxR(absR(v.x), maxR(absR(v.y), absR(v.z))); }

// Point of a triangle with the corner p0 and the edges e1 = p1 - p0, e2 = p2 - p0. A coordinate that all corners share
// is exact.
FN real3 trianglePoint(real3 p0, real3 e1, real3 e2, real b1, real b2) { return p0 + (e1 * b1 + e2 * b2); }

// Point of a triangle's plane close to p, and on a ray. The barycentric coordinates of an intersection err with the
// size of the triangle, a point on the ray with the ray's length, so that it is better where the ray is the shorter. p:
// a point of the plane near the hit; face: unit normal; size: of the triangle. Where the ray grazes the plane and the
// two points differ by more than rounding explains, it is p.
FN real3 pointOnRay(real3 p, real3 origin, real3 d, real3 face, real size) {
  real slope = dot3(d, face);
  mask grazing = lessR(absR(slope), R(1e-6));
  real3 q = origin + d * (dot3(p - origin, face) / selectR(grazing, R(1.0), slope));
  // The point on the ray is off the plane by its own rounding.
  q = q + face * dot3(p - q, face);
  return select3(orM(grazing, lessR(R(1e-5) * size, largestPart(q - p))), p, q);
}

// Bound on the rounding error of one coordinate of trianglePoint. With u the unit roundoff and gamma(n) = n u/(1 - n
// u), the last sum errs by u |p|, as do the point moved onto its ray and the origin of a ray that leaves it, and the
// offset from the corner by gamma(3) of its absolute terms: together gamma(4) of those and gamma(3) of |p0|. Twice as
// much allows for a device that rounds to either of the two nearest numbers. Method: Pharr, Jakob and Humphreys,
// Physically Based Rendering, 4th edition, 6.8.5.
FN real coordinateError(real p0, real e1, real e2, real b1, real b2, real unitRoundoff) {
  real gamma8 = R(8.0) * unitRoundoff / (R(1.0) - R(8.0) * unitRoundoff);
  return (absR(p0) * R(0.75) + absR(e1 * b1) + absR(e2 * b2)) * gamma8;
}
FN real3 hitPointError(real3 p0, real3 e1, real3 e2, real b1, real b2, real unitRoundoff) {
  return make3(coordinateError(p0.x, e1.x, e2.x, b1, b2, unitRoundoff),
               coordinateError(p0.y, e1.y, e2.y, b1, b2, unitRoundoff),
               coordinateError(p0.z, e1.z, e2.z, b1, b2, unitRoundoff));
}

// Distance within which an intersector may still find the triangle that a ray leaves. It subtracts the origin from the
// corners and multiplies the differences, so that its error grows with the triangle and not with the point: 8 roundings
// of the largest difference. Measured: lavapipe finds the triangle again with 1 rounding, and not with 2; Embree needs
// none.
FN real intersectionError(real3 p0, real3 p1, real3 p2, real3 p, real unitRoundoff) {
  return R(8.0) * unitRoundoff * maxR(largestPart(p0 - p), maxR(largestPart(p1 - p), largestPart(p2 - p)));
}

// Bound per axis on the error by the origin of a mesh: adding it to the hit point, and subtracting it from the ray's
// origin in the transform of an instance, with a margin for the order of a transform's sums. 0 without an origin.
FN real3 originError(real3 origin, real unitRoundoff) {
  real most = R(8.0) * unitRoundoff;
  return make3(absR(origin.x) * most, absR(origin.y) * most, absR(origin.z) * most);
}

// Bound per axis on the error that the transform of an instance adds: of queries, which transform the ray to the mesh
// and find its triangles there, and of the point that is transformed to the scene. With the linear part A, its inverse
// W, the point o of the scene and the largest coordinate m of the triangle in the mesh: the sums of W (o - t) err by 11
// roundings of |W| |o| at most, of which originError has 8; the entries of W, which devices compute in single
// precision, and the intersection in the mesh, err with m. spread: columns of |A| |W|; extent: the factor of m, which
// the host computes (render/scene/mesh_transform.h).
FN real3 placementError(real3 spreadX, real3 spreadY, real3 spreadZ, real3 extent, real3 o, real m, real unitRoundoff) {
  real3 far = spreadX * absR(o.x) + spreadY * absR(o.y) + spreadZ * absR(o.z);
  return far * (R(8.0) * unitRoundoff) + extent * (m * unitRoundoff);
}

// A point of the triangle close to p and, where there is room, at least `distance` from its edges. A ray from an edge
// starts on the neighbour's plane, where rounding may put its origin behind the neighbour, and leaks. The point moves
// away from the nearest edge, at most until another edge is as near; then, for corners, toward the centre of the
// inscribed circle, by at most 16 times the distance. It never leaves the triangle. normal: cross product of p1 - p0
// and p2 - p0.
FN real3 insideTriangle(real3 p, real3 p0, real3 p1, real3 p2, real b0, real b1, real b2, real3 normal, real distance) {
  real3 e0 = p2 - p1;
  real3 e1 = p0 - p2;
  real3 e2 = p1 - p0;
  real l0 = sqrtR(dot3(e0, e0));
  real l1 = sqrtR(dot3(e1, e1));
  real l2 = sqrtR(dot3(e2, e2));
  real area = sqrtR(dot3(normal, normal));
  mask none = lessEqualR(minR(area, minR(l0, minR(l1, l2))), R(1e-37));
  // Compute the distances from the edges and the edges' unit normals inward; a coordinate below 0 is rounding error.
  real3 unit = normal * (R(1.0) / selectR(none, R(1.0), area));
  real i0 = R(1.0) / selectR(none, R(1.0), l0);
  real i1 = R(1.0) / selectR(none, R(1.0), l1);
  real i2 = R(1.0) / selectR(none, R(1.0), l2);
  real d0 = maxR(b0, R(0.0)) * area * i0;
  real d1 = maxR(b1, R(0.0)) * area * i1;
  real d2 = maxR(b2, R(0.0)) * area * i2;
  real3 n0 = cross3(unit, e0 * i0);
  real3 n1 = cross3(unit, e1 * i1);
  real3 n2 = cross3(unit, e2 * i2);
  // Order them: the nearest edge and the two others.
  mask first = andM(lessEqualR(d0, d1), lessEqualR(d0, d2));
  mask second = lessEqualR(d1, d2);
  real near = selectR(first, d0, selectR(second, d1, d2));
  real3 nNear = select3(first, n0, select3(second, n1, n2));
  real left = selectR(first, d1, d0);
  real3 nLeft = select3(first, n1, n0);
  real right = selectR(first, d2, selectR(second, d2, d1));
  real3 nRight = select3(first, n2, select3(second, n2, n1));
  real cosLeft = dot3(nNear, nLeft);
  real cosRight = dot3(nNear, nRight);
  real room = minR((left - near) / maxR(R(1.0) - cosLeft, R(1e-6)), (right - near) / maxR(R(1.0) - cosRight, R(1e-6)));
  real away = maxR(minR(distance - near, room), R(0.0));
  real3 q = p + nNear * away;
  // Move the rest of the distance toward the centre of the inscribed circle.
  real clearance = minR(near + away, minR(left + away * cosLeft, right + away * cosRight));
  real sum = selectR(none, R(1.0), l0 + l1 + l2);
  real3 toCentre = (p0 * l0 + p1 * l1 + p2 * l2) * (R(1.0) / sum) - q;
  real radius = area / sum;
  real share = clampUnit((distance - clearance) / maxR(radius - clearance, R(1e-37)));
  share = minR(share, R(16.0) * distance / maxR(largestPart(toCentre), R(1e-37)));
  return select3(none, p, q + toCentre * share);
}

// Origin of a ray that leaves p on the side of n: outside the error box of p, and one rounding step further. n: unit
// face normal on the side that the ray leaves to; error: half the size of the box, per axis. Source: as above, 6.8.6.
FN real3 rayOrigin(real3 p, real3 error, real3 n, real unitRoundoff) {
  real distance = dot3(error, make3(absR(n.x), absR(n.y), absR(n.z)));
  real3 o = p + n * distance;
  real step = R(2.0) * unitRoundoff;
  return make3(o.x + signNotZero(n.x) * absR(o.x) * step, o.y + signNotZero(n.y) * absR(o.y) * step,
               o.z + signNotZero(n.z) * absR(o.z) * step);
}
