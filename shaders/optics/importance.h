// Importance of polarized light: what a Stokes vector at one place of an eye path counts for at the eye is its
// product with a row (w, q, u, v), followed from the eye on. Rows are never divided by w, which may vanish.
// Frames as in stokes.h, of the light. Derivation: CONVENTIONS.md.

struct ImportanceVector {
  real w;
  real q;
  real u;
  real v;
};

// The same row in a frame turned by f about the propagation. row' S' = row S with S' = R(f) S makes row R(-f), which
// is how a Stokes vector turns.
FN ImportanceVector rotateImportance(ImportanceVector r, real cos2, real sin2) {
  ImportanceVector t;
  t.w = r.w;
  t.q = r.q * cos2 + r.u * sin2;
  t.u = r.u * cos2 - r.q * sin2;
  t.v = r.v;
  return t;
}

FN ImportanceVector selectImportance(mask m, ImportanceVector a, ImportanceVector b) {
  ImportanceVector t;
  t.w = selectR(m, a.w, b.w);
  t.q = selectR(m, a.q, b.q);
  t.u = selectR(m, a.u, b.u);
  t.v = selectR(m, a.v, b.v);
  return t;
}

FN ImportanceVector scaleImportance(ImportanceVector r, real scale) {
  ImportanceVector t;
  t.w = r.w * scale;
  t.q = r.q * scale;
  t.u = r.u * scale;
  t.v = r.v * scale;
  return t;
}

// From the light that leaves an interface to the light that meets it: the row times the Mueller matrix of stokes.h
// (stokesInterface). Transmission has the same form with x real.
FN ImportanceVector applyInterfaceTransposed(ImportanceVector r, real rs, real rp, real xRe, real xIm) {
  real mean = (rs + rp) * R(0.5);
  real difference = (rs - rp) * R(0.5);
  ImportanceVector t;
  t.w = mean * r.w + difference * r.q;
  t.q = mean * r.q + difference * r.w;
  t.u = r.u * xRe + r.v * xIm;
  t.v = r.v * xRe - r.u * xIm;
  return t;
}
