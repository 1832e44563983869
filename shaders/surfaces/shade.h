// Drivers of the recursive methods, by recursion: they trace the rays of a Scattering and combine the light that comes
// back. shade_stack.h does the same without recursion.

// Sends light to the camera through the medium that the ray came through. sDir: s direction of the surface.
FN Payload sendToCamera(IN(Hit) h, SurfaceLight toCamera, real3 sDir, real3 slack) {
  Payload sent = sentPayload(toCamera, h.d, sDir, arrivalTransmittance(h));
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}

// Light of the reflected ray and the highlight, behind the surface's reflection.
FN_INLINE SurfaceLight reflectedLight(IN(Hit) h, IN(Scattering) s, real3 highlight, real3 sDir, INOUT(real3) slack) {
  Payload returned = traceRay(rayAbove(h, s.reflected, h.depth - R(1.0)));
  SurfaceLight arriving = returnedLight(returned, s.reflected, sDir, slack);
  return lightThroughInterface(s.reflection, lightAdd(arriving, lightUnpolarized(highlight)));
}

// Light of the transmitted ray, behind the surface's transmission.
FN_INLINE SurfaceLight transmittedLight(IN(Hit) h, IN(Scattering) s, real3 sDir, INOUT(real3) slack) {
  Payload returned = traceRay(rayBelow(h, s.transmitted, h.depth - R(1.0)));
  return lightThroughInterface(s.transmission, returnedLight(returned, s.transmitted, sDir, slack));
}

FN SurfaceLight roughReflectedLight(IN(Hit) h, IN(Material) m, real3 sDir, INOUT(real3) slack) {
  SurfaceLight sum = lightUnpolarized(splat3(R(0.0)));
  VisibleFacets visible = visibleFacetsAt(h);
  for (uint i = 0u; i < kFacets; ++i) {
    Facet facet = sampleFacet(h, visible, camera.facets[i].x, camera.facets[i].y);
    if (facet.weight > R(0.0)) {
      Payload returned = traceRay(facetRay(h, facet, i));
      sum = lightAdd(sum, facetLight(h, m, facet, returned, sDir, slack));
    }
  }
  return sum;
}

// A surface that reflects and lets diffuse light of the layer below leave through its interface.
FN Payload shadeOpaque(IN(Hit) h, IN(Material) m, IN(Scattering) s) {
  DirectLight direct = directLight(h, m, s.reflected);
  SurfaceLight toCamera = lightFromBelow(s.reflection, direct.diffuse);
  real3 slack = splat3(R(0.0));
  if (kCheckNumerics) slack = (direct.diffuse + direct.highlight) * (R(8.0) * kUnitRoundoff);
  real3 sDir = surfaceS(h.d, s.frameNormal);
  bool rough = false;
  if (kEffectRoughness) rough = isRough(h);
  if (canScatter(h)) {
    if (kEffectRoughness) {
      if (rough) {
        toCamera = lightAdd(toCamera, lightThroughInterface(s.reflection, lightUnpolarized(direct.highlight)));
        toCamera = lightAdd(toCamera, roughReflectedLight(h, m, sDir, slack));
      }
    }
    if (!rough) toCamera = lightAdd(toCamera, reflectedLight(h, s, direct.highlight, sDir, slack));
  }
  return sendToCamera(h, toCamera, sDir, slack);
}

// A surface that reflects and transmits, without diffuse light; only where canScatter(h).
FN Payload shadeTransparent(IN(Hit) h, IN(Material) m, IN(Scattering) s) {
  real3 highlight = directLight(h, m, s.reflected).highlight;
  real3 slack = splat3(R(0.0));
  if (kCheckNumerics) slack = highlight * (R(8.0) * kUnitRoundoff);
  real3 sDir = surfaceS(h.d, s.frameNormal);
  SurfaceLight toCamera = reflectedLight(h, s, highlight, sDir, slack);
  if (s.transmits) toCamera = lightAdd(toCamera, transmittedLight(h, s, sDir, slack));
  return sendToCamera(h, toCamera, sDir, slack);
}

// A surface that only transmits; only where canScatter(h).
FN Payload shadeTransmitting(IN(Hit) h, IN(Scattering) s) {
  real3 slack = splat3(R(0.0));
  real3 sDir = surfaceS(h.d, s.frameNormal);
  SurfaceLight toCamera = transmittedLight(h, s, sDir, slack);
  return sendToCamera(h, toCamera, sDir, slack);
}

// Light that each kind of surface sends toward the camera. Surfaces that transmit are black where no specular
// interaction is left.
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
