// A thin pane of glass as one surface (shaders/optics/thin_glass.h). Both sides are in the medium of outsideEta.

// Terms of one colour. f: refractionTerms of the hit.
FN ThinGlass paneTerms(IN(Hit) h, RefractionTerms f, real internal) {
  if (kEffectSpecularFactors) {
    real share = specularFactor(h.material);
    if (anyM(lessR(share, R(1.0)))) return partialThinGlass(h.c, f, internal, share);
  }
  return thinGlassFromTerms(h.c, f, internal);
}

CONST int kShapeThinGlass = kTransparentShape;

FN Scattering scatterThinGlass(INOUT(Hit) h, IN(Material) m) {
  real3 internal = materialExtra(h.material).transmittanceParallel;
#if MALUS_EFFECT_MESH_TEXTURES
  internal = select3(equalW(meshMaps(h.material).transmittance, 0u), internal, m.radiance);
#endif
  RefractionTerms f = refractionTermsWith(h.c, m.outsideEta, m.eta.y, m.contrast.y);
  ThinGlass red = paneTerms(h, f, internal.x);
  ThinGlass green = paneTerms(h, f, internal.y);
  ThinGlass blue = paneTerms(h, f, internal.z);
  Scattering s;
  s.frameNormal = h.normal;
  s.reflection = termsFromReflectance(red.reflected, green.reflected, blue.reflected);
  s.reflected = mirrorDirection(h.d, h.normal, h.c);
  s.transmission = termsFromReflectance(red.transmitted, green.transmitted, blue.transmitted);
  s.transmitted = h.d;
  s.reflects = true;
  s.transmits = true;
  s.coloured = true;
  return s;
}
