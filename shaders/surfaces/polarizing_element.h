// Polarizers and wave plates: thin elements that light passes straight through. They reflect nothing.

// Normal of the plane whose s direction is the element's axis of the terms: of a polarizer the direction of the light
// that it transmits, perpendicular to its absorbing axis, which is in the element across the transmission axis; of a
// wave plate the fast axis, seen along the ray. Source: Korger et al., The polarization properties of a tilted
// polarizer, Optics Express 21, 27032 (2013).
FN real3 polarizingElementNormal(IN(Hit) h) { return cross3(h.face, materialExtra(h.material).axis); }

// Mueller terms of one colour: [[A, B], [B, A]] of the two transmittances on (S0, S1), and
// X = sqrt(T_parallel T_crossed) e^{-i delta} on (S2, S3), delta the retardance.
FN Reflectance polarizingElementReflectance(real parallel, real crossed, real cosine, real sine) {
  real x = sqrtR(parallel * crossed);
  Reflectance r;
  r.rs = parallel;
  r.rp = crossed;
  r.xRe = x * cosine;
  r.xIm = R(0.0) - x * sine;
  return r;
}

FN FresnelTerms polarizingElementTerms(word material) {
  MaterialExtra e = materialExtra(material);
  return termsFromReflectance(polarizingElementReflectance(e.transmittanceParallel.x, e.transmittanceCrossed.x,
                                                           e.retardanceCos.x, e.retardanceSin.x),
                              polarizingElementReflectance(e.transmittanceParallel.y, e.transmittanceCrossed.y,
                                                           e.retardanceCos.y, e.retardanceSin.y),
                              polarizingElementReflectance(e.transmittanceParallel.z, e.transmittanceCrossed.z,
                                                           e.retardanceCos.z, e.retardanceSin.z));
}

CONST int kShapePolarizingElement = kTransmittingShape;

FN Scattering scatterPolarizingElement(IN(Hit) h, IN(Material) m) {
  Scattering s;
  s.frameNormal = polarizingElementNormal(h);
  s.transmission = polarizingElementTerms(h.material);
  s.transmitted = h.d;
  s.reflects = false;
  s.transmits = true;
  s.coloured = true;
  return s;
}
