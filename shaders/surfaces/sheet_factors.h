// Thin sheets that light passes straight through: polarizers and wave plates. They reflect nothing.

#if MALUS_EFFECT_SHEET
// The normal whose s direction is that of the light that a polarizer passes: along its absorbing axis, which lies in
// the sheet across the transmitting one. Source: Korger et al., The polarization properties of a tilted polarizer,
// Optics Express 21, 2013. Of a wave plate alike: s is its fast axis, seen along the ray.
FN real3 sheetNormal(IN(Hit) h) { return cross3(h.face, extras[h.material].axis); }

// X = sqrt(T_s T_p) e^{-i delta} on (S2, S3): optics.h of the importance form, G.
FN Reflectance sheetReflectance(real along, real across, real cosine, real sine) {
  real x = sqrtR(along * across);
  Reflectance r;
  r.rs = along;
  r.rp = across;
  r.xRe = x * cosine;
  r.xIm = R(0.0) - x * sine;
  return r;
}
// Used as a reflection is, on light that comes straight through.
FN Factors sheetFactors(uint index) {
  MaterialExtra e = extras[index];
  return exactFactors(sheetReflectance(e.along.x, e.across.x, e.retardanceCos.x, e.retardanceSin.x),
                      sheetReflectance(e.along.y, e.across.y, e.retardanceCos.y, e.retardanceSin.y),
                      sheetReflectance(e.along.z, e.across.z, e.retardanceCos.z, e.retardanceSin.z));
}
#endif
