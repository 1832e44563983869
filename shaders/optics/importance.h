// Importance of polarized light: a row vector (w, q, u, v) whose product with the Stokes vector of the light at a
// vertex of the camera path is the intensity that the camera records. It is followed from the camera and never divided
// by w, which may vanish. Frames are those of the light, as in stokes.h. Derivation: CONVENTIONS.md, Importance.

struct ImportanceVector {
  real w;
  real q;
  real u;
  real v;
};

// The vector in a frame rotated by f about the propagation; cos2 = cos 2f, sin2 = sin 2f. From row' S' = row S and
// S' = R(f) S follows row' = row R(-f), which is how a Stokes vector rotates.
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

// From the light that leaves an interface to the light that arrives at it: row times the Mueller matrix of
// stokesInterface. For a transmission the terms are T_s, T_p and sqrt(T_s T_p).
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
