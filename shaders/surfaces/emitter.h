// Gives off light on the side of its normal, unpolarized or, as a display does, linearly polarized; reflects nothing.
FN Payload shadeEmitter(IN(Hit) h, IN(Material) m) {
  real3 none = splat3(R(0.0));
  real3 radiance = select3(h.outside, m.radiance, none);
#if MALUS_EFFECT_ABSORPTION
  radiance = radiance * mediumTransmittance(h, m);
#endif
#if MALUS_EFFECT_POLARIZED_EMITTERS
  // Without polarization the light has no direction across the ray, which the methods of the paper tell apart.
  real degree = extras[h.material].degree;
  Payload sent = payloadUnpolarized(radiance);
  if (degree > R(0.0))
    sent = payloadFromSurface(lightPolarized(radiance, degree), h.d,
                              surfaceS(h.d, cross3(h.face, extras[h.material].axis)));
  if (kCheckNumerics) checkSent(h, sent, radiance * (R(8.0) * kUnitRoundoff));
#else
  Payload sent = payloadUnpolarized(radiance);
  if (kCheckNumerics) checkSent(h, sent, none);
#endif
  return sent;
}
