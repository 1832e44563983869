// Opaque interfaces, paint, mirror glass and metal: they reflect, and diffuse light of the layer below leaves through
// them with T = 1 - R (section 2 of the paper).

CONST int kShapePaint = kOpaqueShape;

FN Scattering scatterPaint(IN(Hit) h, IN(Material) m) {
  Scattering s;
  s.frameNormal = h.normal;
  s.reflection = coatedDielectricTerms(h.c, m, h.material);
  s.reflected = mirrorDirection(h.d, h.normal, h.c);
  s.reflects = true;
  s.transmits = false;
  s.coloured = false;
  if (kEffectCoatings) s.coloured = hasFilm(h.material);
  return s;
}

CONST int kShapeMetal = kOpaqueShape;

FN Scattering scatterMetal(IN(Hit) h, IN(Material) m) {
  Scattering s;
  s.frameNormal = h.normal;
  s.reflection = coatedConductorTerms(h.c, m, h.material);
  s.reflected = mirrorDirection(h.d, h.normal, h.c);
  s.reflects = true;
  s.transmits = false;
  s.coloured = true;
  return s;
}
