// Stokes vectors of three colours and the Mueller matrices of rotation, reflection and transmission. Looking toward the
// source: S0 total, S1 along x minus along y, S2 at +45 minus at -45 degrees, counter-clockwise, S3 right minus left
// circular. Signs as in Mitsuba 3 (CONVENTIONS.md, Light).

struct Stokes {
  real3 s0;
  real3 s1;
  real3 s2;
  real3 s3;
};

FN Stokes stokesUnpolarized(real3 radiance) {
  Stokes s;
  s.s0 = radiance;
  s.s1 = splat3(R(0.0));
  s.s2 = splat3(R(0.0));
  s.s3 = splat3(R(0.0));
  return s;
}

FN Stokes stokesAdd(Stokes a, Stokes b) {
  Stokes s;
  s.s0 = a.s0 + b.s0;
  s.s1 = a.s1 + b.s1;
  s.s2 = a.s2 + b.s2;
  s.s3 = a.s3 + b.s3;
  return s;
}

// The same light in a frame rotated by f about the propagation: (S1, S2) -> [[cos 2f, sin 2f], [-sin 2f, cos 2f]] (S1,
// S2).
FN Stokes rotateStokes(Stokes a, real cos2, real sin2) {
  Stokes s;
  s.s0 = a.s0;
  s.s1 = a.s1 * cos2 + a.s2 * sin2;
  s.s2 = a.s2 * cos2 - a.s1 * sin2;
  s.s3 = a.s3;
  return s;
}

// Light that an interface reflects: [[A, B], [B, A]] on (S0, S1) and [[Re X, -Im X], [Im X, Re X]] on (S2, S3), with
// A = (R_s + R_p)/2, B = (R_s - R_p)/2 and X = r_p conj(r_s) of fresnel.h. For a transmission the terms are T_s, T_p
// and sqrt(T_s T_p). The x of both frames is the s direction of the surface.
FN Stokes stokesInterface(Stokes a, real3 rs, real3 rp, real3 xRe, real3 xIm) {
  real3 mean = (rs + rp) * R(0.5);
  real3 difference = (rs - rp) * R(0.5);
  Stokes s;
  s.s0 = mean * a.s0 + difference * a.s1;
  s.s1 = difference * a.s0 + mean * a.s1;
  s.s2 = xRe * a.s2 - xIm * a.s3;
  s.s3 = xIm * a.s2 + xRe * a.s3;
  return s;
}
