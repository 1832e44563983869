// Barycentric coordinates where a ray meets the plane of a triangle, for renderers that take only the triangle from
// their acceleration structure.

struct Barycentrics {
  real b1, b2;  // of p1 and p2, inside the triangle: 0 <= b1, 0 <= b2, b1 + b2 <= 1
};

// Volume that the edge from p to q and the ray span, -2 d . (p x q) (Pluecker coordinates: Shoemake, Ray Tracing News
// 11(1), 1998).
FN real edgeVolume(real3 d, real3 p, real3 q) { return dot3(cross3(q - p, q + p), d); }

// from: origin of the ray; p0, p1, p2: corners, in the same frame. A ray in the plane of the triangle, or a triangle
// without area, gives p0. The corners of a triangle that is smaller than its distance are taken relative to the point
// of the ray that is nearest to p0: relative to the origin they would lose 1.5 times as much to rounding.
FN Barycentrics barycentricCoordinates(real3 from, real3 d, real3 p0, real3 p1, real3 p2) {
  real distance = dot3(p0 - from, d);
  mask isSmall = lessR(maxR(largestPart(p1 - p0), largestPart(p2 - p0)), absR(distance));
  real3 origin = from + d * selectR(isSmall, distance, R(0.0));
  real3 q0 = p0 - origin;
  real3 q1 = p1 - origin;
  real3 q2 = p2 - origin;
  real w0 = edgeVolume(d, q1, q2);
  real w1 = edgeVolume(d, q2, q0);
  real w2 = edgeVolume(d, q0, q1);
  real sum = w0 + w1 + w2;
  mask flat = lessEqualR(absR(sum), R(0.0));
  real scale = R(1.0) / selectR(flat, R(1.0), sum);
  Barycentrics b;
  b.b1 = selectR(flat, R(0.0), clampUnit(w1 * scale));
  b.b2 = selectR(flat, R(0.0), minR(maxR(w2 * scale, R(0.0)), R(1.0) - b.b1));
  return b;
}
