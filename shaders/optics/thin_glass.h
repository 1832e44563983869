// A thin pane of glass as one surface: both interfaces and all reflections between them, summed incoherently as Mueller
// matrices. The pane is thicker than the coherence length (no interference, see film.h) and thin compared with the
// scene: light leaves where it arrived, and transmitted light keeps its direction.
//
// With R and T = 1 - R of one interface, X = r_p conj(r_s) and the one-way transmittance a of the inside, the geometric
// series over the internal reflections is, per polarization,
//   T' = T^2 a / (1 - R^2 a^2),   R' = R + T^2 R a^2 / (1 - R^2 a^2)
// and for the cross terms, whose factor is X per internal reflection and T_s T_p per pair of transmissions,
//   Y' = T_s T_p a / (1 - X^2 a^2),   X' = X + T_s T_p X a^2 / (1 - X^2 a^2).
// Y' is less than sqrt(T_s' T_p'): the sum depolarizes. Source: Born and Wolf, Principles of Optics, 7th edition,
// 7.6.1, with powers in place of amplitudes.
//
// At grazing incidence R and X tend to 1 and the plain denominators cancel. The forms here use
//   1 - R^2 = T (2 - T),   1 - X^2 = T_s + T_p - T_s T_p,   1 - q a^2 = (1 - a^2) + a^2 (1 - q).

// Mueller terms of the pane in the s and p frame of its surface, for reflected and transmitted light.
struct ThinGlass {
  Reflectance reflected;
  Reflectance transmitted;  // rs, rp: T_s', T_p'; xRe: Y'; xIm: 0
};

// 1 - e^-x for x >= 0, without cancellation: the Taylor series to x^8 below 0.03, where its relative error is under
// 2e-18.
FN real absorbedFraction(real x) {
  real tail = R(1.0) - x / R(6.0) * (R(1.0) - x / R(7.0) * (R(1.0) - x / R(8.0)));
  real series =
      x * (R(1.0) - x / R(2.0) * (R(1.0) - x / R(3.0) * (R(1.0) - x / R(4.0) * (R(1.0) - x / R(5.0) * tail))));
  return selectR(lessR(x, R(0.03)), series, R(1.0) - attenuation(x));
}

// Sum of one polarization: T' and R' from R, T = 1 - R, a = e^-x and loss = 1 - a^2. T = 0 gives T' = 0 and R' = R.
FN void sumInternalReflections(real r, real t, real a, real loss, OUT(real) transmitted, OUT(real) reflected) {
  real denominator = loss + a * a * (t * (R(2.0) - t));
  real ratio = t / divisor(denominator);
  transmitted = minR(a * t * ratio, R(1.0));
  reflected = minR(r * (R(1.0) + a * a * t * ratio), R(1.0));
}

// Optical depth of the inside along the refracted ray. Beer-Lambert: the path is longer than the thickness by 1 / cos
// of the refracted angle, which is eta / f.t. internal: as of thinGlassFromTerms.
FN real paneDepth(RefractionTerms f, real internal) {
  real x = opticalDepth(maxR(internal, R(1e-30))) * f.eta / maxR(f.t, R(1e-30));
  return minR(maxR(x, R(0.0)), R(80.0));
}

// c: cosine of incidence, 0 to 1; f: refractionTerms of c, the index n1 of the medium on both sides and the index n2 of
// the glass; internal: transmittance of the inside at normal incidence, without the interfaces, 0 to 1 (the internal
// transmittance of glass catalogues).
FN ThinGlass thinGlassFromTerms(real c, RefractionTerms f, real internal) {
  Reflectance r = reflectanceFromTerms(c, f);
  Transmittance t = transmittanceFromTerms(c, f);
  real x = paneDepth(f, internal);
  real a = attenuation(x);
  real loss = absorbedFraction(R(2.0) * x);
  ThinGlass pane;
  sumInternalReflections(r.rs, t.ts, a, loss, pane.transmitted.rs, pane.reflected.rs);
  sumInternalReflections(r.rp, t.tp, a, loss, pane.transmitted.rp, pane.reflected.rp);
  real denominator = loss + a * a * (t.ts + t.tp - t.ts * t.tp);
  real ratio = t.tp / divisor(denominator);
  pane.transmitted.xRe = a * t.ts * ratio;
  pane.transmitted.xIm = R(0.0);
  real gain = R(1.0) + a * a * t.ts * ratio;
  pane.reflected.xRe = r.xRe * gain;
  pane.reflected.xIm = r.xIm * gain;
  return pane;
}
FN ThinGlass thinGlass(real c, real n1, real n2, real internal) {
  return thinGlassFromTerms(c, refractionTerms(c, n1, n2), internal);
}

// The same where the interfaces cover a share of the pane, 0 to 1, and the rest of it only absorbs. Total reflection is
// not reduced: there is no refracted ray.
FN ThinGlass partialThinGlass(real c, RefractionTerms f, real internal, real share) {
  ThinGlass pane = thinGlassFromTerms(c, f, internal);
  real covered = selectR(f.total, R(1.0), share);
  real open = (R(1.0) - covered) * attenuation(paneDepth(f, internal));
  pane.reflected = shareOfReflectance(pane.reflected, covered);
  pane.transmitted.rs = minR(pane.transmitted.rs * covered + open, R(1.0));
  pane.transmitted.rp = minR(pane.transmitted.rp * covered + open, R(1.0));
  pane.transmitted.xRe = pane.transmitted.xRe * covered + open;
  return pane;
}
