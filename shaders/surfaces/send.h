// Light that leaves a surface with s direction s toward the eye, through the medium that the ray came through. slack:
// of the light that met the surface (check.h).
FN Payload sendToCamera(IN(Hit) h, IN(Material) m, SurfaceLight toCamera, real3 s, real3 slack) {
#if MALUS_EFFECT_ABSORPTION
  toCamera = lightScale(toCamera, mediumTransmittance(h, m));
#endif
  Payload sent = payloadFromSurface(toCamera, h.d, s);
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}
