// Reference frames of Stokes vectors: right-handed (x, y, z), z along the propagation of the light, which is -d for a
// ray followed from the camera in direction d. Rotations are given as cosine and sine of twice the angle; no angle is
// formed (CONVENTIONS.md, Frames).

// Canonical frame of a propagation direction, on which both ends of a ray agree without sending it. It jumps where z.z
// passes -1e-30, and not at 0, where a zero may change its sign and a denormal may be flushed between the two ends.
// Source: Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017, branchlessONB.
FN void canonicalFrame(real3 z, OUT(real3) x, OUT(real3) y) {
  real sign = selectR(lessR(z.z, R(-1e-30)), R(-1.0), R(1.0));
  real a = R(-1.0) / (sign + z.z);
  real b = z.x * z.y * a;
  x = make3(R(1.0) + sign * z.x * z.x * a, sign * b, R(0.0) - sign * z.x);
  y = make3(b, sign + z.y * z.y * a, R(0.0) - z.y);
}

// Unit s direction for a ray in direction d at a surface with normal n: perpendicular to both. It follows from n's
// components perpendicular to the ray, so that it stays perpendicular to the ray where a normalized cross product would
// not. The reflected and the refracted ray are in the plane of d and n, so that one s serves all three rays. Near
// normal incidence, where the plane of incidence is uncertain or undefined, the choice of s cancels, because r_p = -r_s
// there. Squares below 1e-30 have lost their precision: s is then the canonical x.
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

// Rotation by the angle f from a frame's x to a direction s perpendicular to the ray: cos 2f and sin 2f. Normalized by
// s's components, so that a rotation never changes the degree of polarization; an s along the ray gives the identity.
FN void frameRotation(real3 s, real3 x, real3 y, OUT(real) cos2, OUT(real) sin2) {
  real a = dot3(s, x);
  real b = dot3(s, y);
  real sum = a * a + b * b;
  mask none = lessR(sum, R(1e-30));
  real inverse = R(1.0) / selectR(none, R(1.0), sum);
  cos2 = selectR(none, R(1.0), (a - b) * (a + b) * inverse);
  sin2 = selectR(none, R(0.0), R(2.0) * a * b * inverse);
}

// Rotation from the canonical frame of the light of a ray in direction d to the frame whose x is s: cosine and sine of
// twice the angle.
FN void canonicalRotation(real3 d, real3 s, OUT(real) cos2, OUT(real) sin2) {
  real3 x;
  real3 y;
  canonicalFrame(d * R(-1.0), x, y);
  frameRotation(s, x, y, cos2, sin2);
}
