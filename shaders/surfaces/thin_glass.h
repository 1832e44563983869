// A thin pane of glass as one surface (shaders/optics/thin_glass.h). Both sides are in the medium of outsideEta.

CONST int kShapeThinGlass = kTransparentShape;

FN Scattering scatterThinGlass(INOUT(Hit) h, IN(Material) m) {
  real3 internal = materialExtra(h.material).transmittanceParallel;
  ThinGlass red = thinGlass(h.c, m.outsideEta, m.eta.y, internal.x);
  ThinGlass green = thinGlass(h.c, m.outsideEta, m.eta.y, internal.y);
  ThinGlass blue = thinGlass(h.c, m.outsideEta, m.eta.y, internal.z);
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
