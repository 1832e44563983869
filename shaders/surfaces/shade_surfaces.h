// Recursive methods: light that each kind of surface sends toward the camera. Surfaces that transmit are black where no
// specular interaction is left.

FN Payload shadeLambert(IN(Hit) h, IN(Material) m) {
  real3 diffuse = directLight(h, m, h.normal).diffuse;
  if (kEffectAbsorption) diffuse = diffuse * mediumTransmittance(h);
  Payload sent = payloadUnpolarized(diffuse);
  if (kCheckNumerics) checkSent(h, sent, splat3(R(0.0)));
  return sent;
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

#define MALUS_RULE_ROW(id, name, alias, description)
#define MALUS_SHADER_ROW(id, macro, build, name, alias, description)
#define MALUS_SOURCE_ROW(id, macro, build, name, alias, description)
#define MALUS_SURFACE_ROW(id, macro, build, name, alias, description)      \
  FN Payload shade##id(INOUT(Hit) h, IN(Material) m) {                     \
    if (kShape##id != kOpaqueShape && !canScatter(h)) return black();      \
    Scattering s = scatter##id(h, m);                                      \
    if (kShape##id == kOpaqueShape) return shadeOpaque(h, m, s);           \
    if (kShape##id == kTransparentShape) return shadeTransparent(h, m, s); \
    return shadeTransmitting(h, s);                                        \
  }
#include "shaders/effects.def"
