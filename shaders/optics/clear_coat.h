// A clear coat: a plane layer of real index on a dielectric or a conductor, thicker than the coherence length (no
// interference, see film.h) and thin compared with the scene. The reflections inside are summed as Mueller matrices.
//
// In the plane of incidence the Mueller matrices of isotropic interfaces commute: on (S0, S1) they are diagonal in s
// and p, on (S2, S3) they multiply S2 + i S3 by X = r_p conj(r_s). With interface 1 met first, 2 met second, and the
// transmittances T = 1 - R and Y = sqrt(T_s T_p), the geometric series is
//   R = R1 + T1^2 R2 / (1 - R1 R2)            T = T1 T2 / (1 - R1 R2)      for s and p
//   X = X1 + Y1^2 X2 / (1 - X1 X2)            Y = Y1 Y2 / (1 - X1 X2)
// Interface 1 has the same R and X from inside the coat, because Stokes's relation r' = -r holds for s and p; where it
// reflects totally, T1 is 0. Source: Born and Wolf, Principles of Optics, 7th edition, 1.6.3 and 7.6.1, with powers in
// place of amplitudes.
//
// At grazing incidence R1 tends to 1: 1 - R1 R2 is evaluated as T1 + R1 T2. 1 - X1 X2 then has the absolute error of a
// rounding, by which |X| could exceed sqrt(R_s R_p), its bound for a sum of unpolarizing paths: it is limited to that.

struct ClearCoat {
  Reflectance reflected;
  Reflectance transmitted;  // rs, rp: T_s, T_p; X: Y. Into a conductor Y is 0
};

// One interface of the stack.
struct CoatInterface {
  Reflectance r;
  Transmittance t;
};

// An interface that covers a share of its surface; the rest transmits everything. Total reflection is not reduced.
FN CoatInterface dielectricInterface(real c, RefractionTerms f, real share) {
  CoatInterface i;
  i.t = transmittanceFromTerms(c, f);
  real covered = selectR(f.total, R(1.0), share);
  real open = R(1.0) - covered;
  i.r = shareOfReflectance(reflectanceFromTerms(c, f), covered);
  i.t.ts = minR(i.t.ts * covered + open, R(1.0));
  i.t.tp = minR(i.t.tp * covered + open, R(1.0));
  i.t.x = i.t.x * covered + open;
  return i;
}

// R and T of one polarization.
FN void sumCoatPowers(real r1, real t1, real r2, real t2, OUT(real) reflected, OUT(real) transmitted) {
  real ratio = t1 / divisor(t1 + r1 * t2);
  reflected = minR(r1 + t1 * ratio * r2, R(1.0));
  transmitted = minR(ratio * t2, R(1.0));
}

FN Reflectance limitCrossTerm(Reflectance r) {
  real bound = sqrtR(r.rs * r.rp);
  real size = sqrtR(r.xRe * r.xRe + r.xIm * r.xIm);
  real scale = selectR(lessR(bound, size), bound / divisor(size), R(1.0));
  r.xRe = r.xRe * scale;
  r.xIm = r.xIm * scale;
  return r;
}

FN ClearCoat sumCoat(CoatInterface first, CoatInterface second) {
  ClearCoat s;
  sumCoatPowers(first.r.rs, first.t.ts, second.r.rs, second.t.ts, s.reflected.rs, s.transmitted.rs);
  sumCoatPowers(first.r.rp, first.t.tp, second.r.rp, second.t.tp, s.reflected.rp, s.transmitted.rp);
  // X1 is real where T1 is not 0.
  Complex x2 = makeComplex(second.r.xRe, second.r.xIm);
  Complex series =
      complexDiv(makeComplex(R(1.0), R(0.0)), makeComplex(R(1.0) - first.r.xRe * x2.re, R(0.0) - first.r.xRe * x2.im));
  real twice = first.t.x * first.t.x;
  Complex x = complexMul(x2, series);
  s.reflected.xRe = first.r.xRe + twice * x.re;
  s.reflected.xIm = first.r.xIm + twice * x.im;
  real once = first.t.x * second.t.x;
  s.transmitted.xRe = once * series.re;
  s.transmitted.xIm = once * series.im;
  s.reflected = limitCrossTerm(s.reflected);
  s.transmitted = limitCrossTerm(s.transmitted);
  return s;
}

// Cosine of the angle of incidence on the second interface.
FN real cosineInCoat(RefractionTerms f) { return minR(f.t / divisor(f.eta), R(1.0)); }

// A coat between two dielectrics of the indices n1, in which the light arrives at the cosine c, and n2. share1, share2:
// of the two interfaces.
FN ClearCoat coatOnDielectric(real c, real n1, real coat, real n2, real share1, real share2) {
  RefractionTerms first = refractionTerms(c, n1, coat);
  real inside = cosineInCoat(first);
  return sumCoat(dielectricInterface(c, first, share1),
                 dielectricInterface(inside, refractionTerms(inside, coat, n2), share2));
}

// A coat on a conductor of index n2 - i k2. share: of the interface between them.
FN ClearCoat coatOnConductor(real c, real n1, real coat, real n2, real k2, real share) {
  RefractionTerms first = refractionTerms(c, n1, coat);
  CoatInterface base;
  base.r = conductorReflectance(cosineInCoat(first), coat, n2, k2);
  base.r.rs = base.r.rs * share;
  base.r.rp = base.r.rp * share;
  base.r.xRe = base.r.xRe * share;
  base.r.xIm = base.r.xIm * share;
  base.t.ts = R(1.0) - base.r.rs;
  base.t.tp = R(1.0) - base.r.rp;
  base.t.x = R(0.0);
  return sumCoat(dielectricInterface(c, first, R(1.0)), base);
}
