// Recursive methods: light that the kinds of surface that end a path send toward the camera.

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
    mask polarized = lessR(R(0.0), degree);
    if (anyM(polarized)) {
      SurfaceLight light = lightPolarized(radiance, degree);
      sent = SELECT(polarized, payloadFromSurface(light, h.d, surfaceS(h.d, emissionNormal(h))), sent);
    }
    slack = radiance * (R(8.0) * kUnitRoundoff);
  }
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}

// The light of a surface that ends the path.
FN Payload shadeSource(IN(Hit) h, IN(Material) m, uint kind) {
#define MALUS_SURFACE_ROW(id, macro, build, name, alias, description)
#define MALUS_SOURCE_ROW(id, macro, build, name, alias, description) \
  if (kEffect##id) {                                                 \
    if (kind == k##id) return shade##id(h, m);                       \
  }
#include "shaders/effects.def"
  return black();
}
