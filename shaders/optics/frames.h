// Reference frames of Stokes vectors: right-handed (x, y, z), z along the propagation of the light; for a
// ray that is followed from the eye in direction d that is -d. No angle is ever formed.

// Frame that both ends of a ray agree on without sending it. Source: Duff et al., Building an Orthonormal
// Basis, Revisited, JCGT 6(1), 2017. It jumps where z passes -1e-30 and not at 0: there a zero may change its
// sign and a denormal be flushed between the two ends.
FN void canonicalFrame(real3 z, OUT(real3) x, OUT(real3) y) {
  real sign = selectR(lessR(z.z, R(-1e-30)), R(-1.0), R(1.0));
  real a = R(-1.0) / (sign + z.z);
  real b = z.x * z.y * a;
  x = make3(R(1.0) + sign * z.x * z.x * a, sign * b, R(0.0) - sign * z.x);
  y = make3(b, sign + z.y * z.y * a, R(0.0) - z.y);
}

// Unit s direction of a surface with normal n for a ray in direction d: perpendicular to both. From n's
// components across the ray, so that it stays perpendicular to the ray where a normalized cross product would
// not. Mirrored and refracted rays lie in the plane of d and n: one s serves all three rays of a surface, and
// where the plane of incidence is uncertain (near normal incidence) or does not exist, the choice of s cancels,
// because r_p = -r_s there. Squares under 1e-30 have lost their bits: they count as no plane, s is then x.
FN real3 sDirection(real3 d, real3 n) {
  real3 x;
  real3 y;
  canonicalFrame(d * R(-1.0), x, y);
  real nx = dot3(n, x);
  real ny = dot3(n, y);
  real sum = nx * nx + ny * ny;
  mask none = lessR(sum, R(1e-30));
  real inverse = R(1.0) / sqrtR(selectR(none, R(1.0), sum));
  return x * selectR(none, R(1.0), R(0.0) - ny * inverse) + y * selectR(none, R(0.0), nx * inverse);
}

// Twice the angle f from the frame's x to a unit direction s across the ray, as cosine and sine. Divided by the
// square of s, so that a turn never changes the size of what it turns; an s along the ray turns nothing.
FN void frameRotation(real3 s, real3 x, real3 y, OUT(real) cos2, OUT(real) sin2) {
  real a = dot3(s, x);
  real b = dot3(s, y);
  real sum = a * a + b * b;
  mask none = lessR(sum, R(1e-30));
  real inverse = R(1.0) / selectR(none, R(1.0), sum);
  cos2 = selectR(none, R(1.0), (a - b) * (a + b) * inverse);
  sin2 = selectR(none, R(0.0), R(2.0) * a * b * inverse);
}

// Twice the angle from the canonical frame of the light against a ray in direction d to a unit s direction across it.
FN void canonicalRotation(real3 d, real3 s, OUT(real) cos2, OUT(real) sin2) {
  real3 x;
  real3 y;
  canonicalFrame(d * R(-1.0), x, y);
  frameRotation(s, x, y, cos2, sin2);
}
