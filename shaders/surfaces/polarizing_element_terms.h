// Thin sheets that light passes straight through: polarizers and wave plates. They reflect nothing.

#if MALUS_EFFECT_POLARIZING_ELEMENT
// The normal whose s direction is that of the light that a polarizer passes: along its absorbing axis, which lies in
// the sheet across the transmitting one. Source: Korger et al., The polarization properties of a tilted polarizer,
// Optics Express 21, 2013. Of a wave plate alike: s is its fast axis, seen along the ray.
FN real3 polarizingElementNormal(IN(Hit) h) { return cross3(h.face, extras[h.material].axis); }

// X = sqrt(T_s T_p) e^{-i delta} on (S2, S3): optics.h of the importance form, G.
FN Reflectance polarizingElementReflectance(real along, real across, real cosine, real sine) {
  real x = sqrtR(along * across);
  Reflectance r;
  r.rs = along;
  r.rp = across;
  r.xRe = x * cosine;
  r.xIm = R(0.0) - x * sine;
  return r;
}
// Used as a reflection is, on light that comes straight through.
FN FresnelTerms polarizingElementTerms(uint index) {
  MaterialExtra e = extras[index];
  return termsFromReflectance(polarizingElementReflectance(e.transmittanceParallel.x, e.transmittanceCrossed.x,
                                                           e.retardanceCos.x, e.retardanceSin.x),
                              polarizingElementReflectance(e.transmittanceParallel.y, e.transmittanceCrossed.y,
                                                           e.retardanceCos.y, e.retardanceSin.y),
                              polarizingElementReflectance(e.transmittanceParallel.z, e.transmittanceCrossed.z,
                                                           e.retardanceCos.z, e.retardanceSin.z));
}
#endif
