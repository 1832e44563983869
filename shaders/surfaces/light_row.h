// Transmittance of the way of light from a lamp into a diffuse layer, as the first row of its Mueller matrix, per
// colour. It begins with the interface above the layer, (A_T, B_T, 0, 0) in the plane of incidence, and is multiplied
// from the right by every surface that the light passed before, so that the matrices are in the order of travel from
// the lamp. It follows the same rules as importance (shaders/optics/importance.h).

struct LightRow {
  real3 x;  // frame: unit, perpendicular to the light
  real3 w;
  real3 q;
  real3 u;
  real3 v;
};

// d: direction toward the light; n: normal of the plane of incidence; mean, difference: of T_s and T_p, A_T and B_T.
FN LightRow startRow(real3 d, real3 n, real3 mean, real3 difference) {
  LightRow r;
  r.x = sDirection(d, n);
  r.w = mean;
  r.q = difference;
  r.u = splat3(R(0.0));
  r.v = splat3(R(0.0));
  return r;
}

// Into the frame of a surface with s direction s.
FN LightRow rotateRow(LightRow r, real3 d, real3 s) {
  real cos2;
  real sin2;
  frameRotation(s, r.x, cross3(r.x, d), cos2, sin2);
  LightRow t;
  t.x = s;
  t.w = r.w;
  t.q = r.q * cos2 + r.u * sin2;
  t.u = r.u * cos2 - r.q * sin2;
  t.v = r.v;
  return t;
}

FN ImportanceVector rowOfColour(real w, real q, real u, real v) {
  ImportanceVector r;
  r.w = w;
  r.q = q;
  r.u = u;
  r.v = v;
  return r;
}

// Before a surface whose Mueller terms are those of an interface, in whose frame the row is.
FN LightRow filterRow(LightRow r, Reflectance red, Reflectance green, Reflectance blue) {
  ImportanceVector a =
      applyInterfaceTransposed(rowOfColour(r.w.x, r.q.x, r.u.x, r.v.x), red.rs, red.rp, red.xRe, red.xIm);
  ImportanceVector b =
      applyInterfaceTransposed(rowOfColour(r.w.y, r.q.y, r.u.y, r.v.y), green.rs, green.rp, green.xRe, green.xIm);
  ImportanceVector c =
      applyInterfaceTransposed(rowOfColour(r.w.z, r.q.z, r.u.z, r.v.z), blue.rs, blue.rp, blue.xRe, blue.xIm);
  LightRow t;
  t.x = r.x;
  t.w = make3(a.w, b.w, c.w);
  t.q = make3(a.q, b.q, c.q);
  t.u = make3(a.u, b.u, c.u);
  t.v = make3(a.v, b.v, c.v);
  return t;
}

FN LightRow selectRow(mask m, LightRow a, LightRow b) {
  LightRow r;
  r.x = select3(m, a.x, b.x);
  r.w = select3(m, a.w, b.w);
  r.q = select3(m, a.q, b.q);
  r.u = select3(m, a.u, b.u);
  r.v = select3(m, a.v, b.v);
  return r;
}

// Transmittance for light with a degree of linear polarization along the s direction of a surface with normal n.
FN real3 polarizedTransmittance(LightRow r, real3 d, real3 n, real degree) {
  LightRow at = rotateRow(r, d, sDirection(d, n));
  return max3(at.w + at.q * degree, R(0.0));
}

// The row of light into the layer below the interface of a material at a hit; 1 without an interface. c: cosine of the
// angle of incidence.
FN LightRow enteringRow(IN(Hit) h, IN(Material) m, real3 d, real c) {
  real3 mean = splat3(R(1.0));
  real3 difference = splat3(R(0.0));
  mask opaque = orM(equalW(m.kind, kPaint), equalW(m.kind, kMetal));
  if (anyM(opaque)) {
    FresnelTerms f = opaqueTerms(c, m, h.material);
    mean = select3(opaque, meanTransmittance(f), mean);
    difference = select3(opaque, transmittanceDifference(f), difference);
  }
  return startRow(d, h.normal, mean, difference);
}

// Mueller terms of a thin surface that light passes straight through, per colour, and the s direction of their frame.
struct FilterTerms {
  real3 s;
  Reflectance red;
  Reflectance green;
  Reflectance blue;
};

FN Reflectance selectReflectance(mask m, Reflectance a, Reflectance b) {
  Reflectance r;
  r.rs = selectR(m, a.rs, b.rs);
  r.rp = selectR(m, a.rp, b.rp);
  r.xRe = selectR(m, a.xRe, b.xRe);
  r.xIm = selectR(m, a.xIm, b.xIm);
  return r;
}

FN FilterTerms elementFilter(IN(Hit) h) {
  MaterialExtra e = materialExtra(h.material);
  FilterTerms f;
  f.s = sDirection(h.d, polarizingElementNormal(h));
  f.red = polarizingElementReflectance(e.transmittanceParallel.x, e.transmittanceCrossed.x, e.retardanceCos.x,
                                       e.retardanceSin.x);
  f.green = polarizingElementReflectance(e.transmittanceParallel.y, e.transmittanceCrossed.y, e.retardanceCos.y,
                                         e.retardanceSin.y);
  f.blue = polarizingElementReflectance(e.transmittanceParallel.z, e.transmittanceCrossed.z, e.retardanceCos.z,
                                        e.retardanceSin.z);
  return f;
}

FN FilterTerms paneFilter(IN(Hit) h, IN(Material) m) {
  real3 internal = materialExtra(h.material).transmittanceParallel;
  RefractionTerms t = refractionTermsWith(h.c, m.outsideEta, m.eta.y, m.contrast.y);
  FilterTerms f;
  f.s = sDirection(h.d, h.normal);
  f.red = paneTerms(h, t, internal.x).transmitted;
  f.green = paneTerms(h, t, internal.y).transmitted;
  f.blue = paneTerms(h, t, internal.z).transmitted;
  return f;
}

// The row before the surface of a hit, for light against the direction of the hit's ray. isPane: a thin pane of glass,
// else a polarizing element.
FN LightRow passFilter(LightRow r, IN(Hit) h, IN(Material) m, mask isPane) {
  FilterTerms f = elementFilter(h);
  if (kEffectThinGlass) {
    if (anyM(isPane)) {
      FilterTerms pane = paneFilter(h, m);
      f.s = select3(isPane, pane.s, f.s);
      f.red = selectReflectance(isPane, pane.red, f.red);
      f.green = selectReflectance(isPane, pane.green, f.green);
      f.blue = selectReflectance(isPane, pane.blue, f.blue);
    }
  }
  return filterRow(rotateRow(r, h.d, f.s), f.red, f.green, f.blue);
}
