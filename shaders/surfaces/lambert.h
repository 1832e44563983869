// Bare Lambert: unpolarized diffuse light, no interface.
FN Payload shadeLambert(IN(Hit) h, IN(Material) m) {
  real3 diffuse = directLight(h, m, h.normal).diffuse;
#if MALUS_EFFECT_ABSORPTION
  diffuse = diffuse * mediumTransmittance(h, m);
#endif
  Payload sent = payloadUnpolarized(diffuse);
  if (kCheckNumerics) checkSent(h, sent, splat3(R(0.0)));
  return sent;
}
