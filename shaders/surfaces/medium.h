// Absorption in the media between surfaces (Beer-Lambert).

#if MALUS_EFFECT_ABSORPTION
FN real3 transmittanceOver(real3 absorption, real distance) {
  return make3(expR(R(0.0) - absorption.x * distance), expR(R(0.0) - absorption.y * distance),
               expR(R(0.0) - absorption.z * distance));
}
// Of the medium on the side of the ray, over the way that the ray came. Only glass has an inside.
FN real3 mediumAbsorption(IN(Hit) h, IN(Material) m) {
  if (m.kind == kGlass && !h.outside) return extras[h.material].absorption;
  return extras[h.material].outsideAbsorption;
}
FN real3 mediumTransmittance(IN(Hit) h, IN(Material) m) {
  return transmittanceOver(mediumAbsorption(h, m), h.travelled);
}
#endif
