// Reference frames of Stokes vectors: right-handed (x, y, z), z along the propagation of the light; for a
// ray that is followed from the eye in direction d that is -d. No angle is ever formed.

// Frame that both ends of a ray agree on without sending it. Source: Duff et al., Building an Orthonormal
// Basis, Revisited, JCGT 6(1), 2017. It jumps at z = 0; +0 and -0 give the same frame.
FN void canonicalFrame(real3 z, OUT(real3) x, OUT(real3) y) {
  real sign = signNotZero(z.z);
  real a = R(-1.0) / (sign + z.z);
  real b = z.x * z.y * a;
  x = make3(R(1.0) + sign * z.x * z.x * a, sign * b, R(0.0) - sign * z.x);
  y = make3(b, sign + z.y * z.y * a, R(0.0) - z.y);
}

// Twice the angle f from the frame's x to the s direction of a surface with normal n, as cosine and sine.
// From n's components across the ray, where a normalized cross product would lose orthogonality; where
// the plane of incidence does not exist, f = 0.
FN void sDirectionTurn(real3 n, real3 x, real3 y, OUT(real) cos2, OUT(real) sin2) {
  real nx = dot3(n, x);
  real ny = dot3(n, y);
  real sum = nx * nx + ny * ny;
  mask none = equalR(sum, R(0.0));
  real safe = selectR(none, R(1.0), sum);
  cos2 = selectR(none, R(1.0), (ny - nx) * (ny + nx) / safe);
  sin2 = selectR(none, R(0.0), R(-2.0) * nx * ny / safe);
}
