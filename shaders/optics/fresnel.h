// Fresnel equations of a smooth interface between a medium of real index n1, in which the light arrives, and a medium
// of index n2 - i k2, with time dependence e^{+i w t} and roots with Im <= 0:
//
//   r_s = (c - t)/(c + t),  r_p = (eta^2 c - t)/(eta^2 c + t)
//
// c: cosine of the angle of incidence, in [0, 1]; eta = (n2 - i k2)/n1; t = sqrt(eta^2 - sin^2). The sign of r_p is
// that of CONVENTIONS.md (Interfaces): r_p = -r_s at normal incidence. The functions evaluate
//
//   r_s = -(eta^2 - 1)/(c + t)^2,  rho = r_p/r_s = (sin^2 - c t)/(sin^2 + c t)
//
// which has no difference of nearly equal numbers near an index match but n2 - n1. Rounded indices do not determine it:
// the functions named ...With take it as computed in double precision, the others subtract. Source: Born and Wolf,
// Principles of Optics, 7th edition, 1.5.2 and 14.2. The result depends on the side of viewing only by the frames.

// Power reflectances and the cross term X = r_p conj(r_s), which is all that the Mueller matrix of a reflection needs.
struct Reflectance {
  real rs;   // |r_s|^2, in [0, 1]
  real rp;   // |r_p|^2, in [0, 1]
  real xRe;  // Re X
  real xIm;  // Im X
};

// The reflection of a surface that has an interface on a share of it, 0 to 1.
FN Reflectance shareOfReflectance(Reflectance r, real share) {
  r.rs = r.rs * share;
  r.rp = r.rp * share;
  r.xRe = r.xRe * share;
  r.xIm = r.xIm * share;
  return r;
}

// Flux transmittances of a dielectric; x = sqrt(ts tp).
struct Transmittance {
  real ts;
  real tp;
  real x;
};

// Quantities of refraction at a dielectric: t = sqrt(eta^2 - sin^2), with eta = n2/n1. What uses both reflection and
// transmission computes them from the same terms: near the critical angle two evaluations may differ.
struct RefractionTerms {
  real eta;      // n2/n1
  real etaSq;    // eta^2
  real etaSqM1;  // eta^2 - 1, from n2 - n1 and not from the rounded ratio
  real sinSq;    // sin^2 of the angle of incidence
  real t;        // sqrt(eta^2 - sin^2): eta times the transmitted cosine; 0 in total reflection
  real tau;      // sqrt(sin^2 - eta^2) in total reflection, else 0
  mask total;    // total reflection
  mask matched;  // n1 == n2: no interface
};

// difference: n2 - n1, more accurate than the difference of the rounded indices.
FN RefractionTerms refractionTermsWith(real c, real n1, real n2, real difference) {
  RefractionTerms f;
  f.eta = n2 / n1;
  f.etaSq = f.eta * f.eta;
  f.etaSqM1 = (difference * (n2 + n1)) / (n1 * n1);
  f.sinSq = (R(1.0) - c) * (R(1.0) + c);
  // Take the form with the smaller terms: an eta^2 of 1e-8 is lost beside 1.
  real tSq = selectR(lessR(f.etaSq + f.sinSq, R(1.0)), f.etaSq - f.sinSq, f.etaSqM1 + c * c);
  f.total = lessR(tSq, R(0.0));
  f.matched = equalR(f.etaSqM1, R(0.0));
  f.t = sqrtR(maxR(tSq, R(0.0)));
  f.tau = sqrtR(maxR(R(0.0) - tSq, R(0.0)));
  return f;
}
FN RefractionTerms refractionTerms(real c, real n1, real n2) { return refractionTermsWith(c, n1, n2, n2 - n1); }

// Reflection at a dielectric. Total reflection gives R_s = R_p = 1 exactly; n1 = n2 reflects nothing at every angle.
FN Reflectance reflectanceFromTerms(real c, RefractionTerms f) {
  // Partial reflection: r_s = -(eta^2 - 1)/(c + t)^2, rho = r_p/r_s = (sin^2 - c t)/(sin^2 + c t).
  real sum = c + f.t;
  real rs = f.etaSqM1 / selectR(orM(f.matched, f.total), R(1.0), sum * sum);
  real ct = c * f.t;
  real rho = (f.sinSq - ct) / selectR(f.matched, R(1.0), f.sinSq + ct);
  real rsSq = minR(rs * rs, R(1.0));
  // Total reflection: t = -i tau, R = 1, X = (sin^2 + i c tau)^2 / |sin^2 + i c tau|^2.
  real ctau = c * f.tau;
  real norm = selectR(f.total, f.sinSq * f.sinSq + ctau * ctau, R(1.0));
  Reflectance r;
  r.rs = selectR(f.total, R(1.0), rsSq);
  r.rp = selectR(f.total, R(1.0), minR(rsSq * rho * rho, R(1.0)));
  r.xRe = selectR(f.total, (f.sinSq - ctau) * (f.sinSq + ctau) / norm, rsSq * rho);
  r.xIm = selectR(f.total, R(2.0) * f.sinSq * ctau / norm, R(0.0));
  return r;
}

FN Reflectance dielectricReflectance(real c, real n1, real n2) {
  return reflectanceFromTerms(c, refractionTerms(c, n1, n2));
}

// Transmission through a dielectric: T_s = 4 c t/(c + t)^2, T_p = 4 eta^2 c t/(eta^2 c + t)^2. All 0 in total
// reflection; 1 at every angle for n1 = n2. Source: Born and Wolf, 1.5.
FN Transmittance transmittanceFromTerms(real c, RefractionTerms f) {
  mask none = orM(f.matched, f.total);
  real four = R(4.0) * c * f.t;
  real s = selectR(none, R(1.0), c + f.t);
  real p = selectR(none, R(1.0), f.etaSq * c + f.t);
  real through = selectR(f.total, R(0.0), R(1.0));
  Transmittance t;
  t.ts = selectR(none, through, minR(four / (s * s), R(1.0)));
  t.tp = selectR(none, through, minR(four * f.etaSq / (p * p), R(1.0)));
  t.x = selectR(none, through, minR(four * f.eta / (s * p), R(1.0)));
  return t;
}

FN Transmittance dielectricTransmittance(real c, real n1, real n2) {
  return transmittanceFromTerms(c, refractionTerms(c, n1, n2));
}

// Reflection at a conductor of index n2 - i k2, k2 >= 0; with k2 = 0 a dielectric that only reflects. Source: Born and
// Wolf, 14.2.
FN_TERMS Reflectance conductorReflectanceWith(real c, real n1, real n2, real k2, real difference) {
  real inverse = R(1.0) / n1;
  real n = n2 * inverse;
  real k = k2 * inverse;
  real sinSq = (R(1.0) - c) * (R(1.0) + c);
  // eta^2 - 1 and z = t^2 = (eta^2 - 1) + c^2 = eta^2 - sin^2, complex; Im <= 0.
  real nSqM1 = (difference * (n2 + n1)) * inverse * inverse;
  real eRe = nSqM1 - k * k;
  real eIm = R(-2.0) * n * k;
  real zRe = selectR(lessR(n * n + sinSq, R(1.0)), n * n - sinSq - k * k, eRe + c * c);
  Complex t = complexSqrtLower(zRe, eIm);
  // R_s = |eta^2 - 1|^2 / |c + t|^4
  real qRe = c + t.re;
  real qSq = qRe * qRe + t.im * t.im;
  real eOverQ = (eRe * eRe + eIm * eIm);
  mask matched = equalR(eOverQ, R(0.0));
  real rs = eOverQ / selectR(matched, R(1.0), qSq * qSq);
  // rho = (sin^2 - c t)/(sin^2 + c t)
  real aRe = sinSq - c * t.re;
  real aIm = R(0.0) - c * t.im;
  real bRe = sinSq + c * t.re;
  real bIm = c * t.im;
  real bSq = selectR(matched, R(1.0), bRe * bRe + bIm * bIm);
  real rhoRe = (aRe * bRe + aIm * bIm) / bSq;
  real rhoIm = (aIm * bRe - aRe * bIm) / bSq;
  Reflectance r;
  r.rs = minR(rs, R(1.0));
  r.rp = minR(r.rs * ((aRe * aRe + aIm * aIm) / bSq), R(1.0));
  r.xRe = r.rs * rhoRe;
  r.xIm = r.rs * rhoIm;
  return r;
}
FN Reflectance conductorReflectance(real c, real n1, real n2, real k2) {
  return conductorReflectanceWith(c, n1, n2, k2, n2 - n1);
}
