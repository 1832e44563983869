// Recursive methods: light that each kind of surface sends toward the camera. Surfaces that transmit are black where no
// specular interaction is left.

FN Payload shadeLambert(IN(Hit) h, IN(Material) m) {
  real3 diffuse = directLight(h, m, h.normal).diffuse;
  if (kEffectAbsorption) diffuse = diffuse * mediumTransmittance(h);
  Payload sent = payloadUnpolarized(diffuse);
  if (kCheckNumerics) checkSent(h, sent, splat3(R(0.0)));
  return sent;
}

FN Payload shadePaint(IN(Hit) h, IN(Material) m) {
  Scattering s = paintScattering(h, m);
  return shadeOpaque(h, m, s);
}

FN Payload shadeMetal(IN(Hit) h, IN(Material) m) {
  Scattering s = metalScattering(h, m);
  return shadeOpaque(h, m, s);
}

FN Payload shadeGlass(Hit h, IN(Material) m) {
  if (!canScatter(h)) return black();
  Scattering s = glassScattering(h, m);
  return shadeTransparent(h, m, s);
}

FN Payload shadePolarizingElement(IN(Hit) h, IN(Material) m) {
  if (!canScatter(h)) return black();
  Scattering s = polarizingElementScattering(h);
  return shadeTransmitting(h, s);
}

FN Payload shadeEmitter(IN(Hit) h, IN(Material) m) {
  real3 radiance = emission(h, m);
  if (kEffectAbsorption) radiance = radiance * mediumTransmittance(h);
  Payload sent = payloadUnpolarized(radiance);
  real3 slack = splat3(R(0.0));
  if (kEffectPolarizedEmitters) {
    // Unpolarized light has no s direction, which the methods of the paper distinguish from degree 0.
    real degree = materialExtra(h.material).degree;
    if (degree > R(0.0))
      sent = payloadFromSurface(lightPolarized(radiance, degree), h.d, surfaceS(h.d, emissionNormal(h)));
    slack = radiance * (R(8.0) * kUnitRoundoff);
  }
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}
