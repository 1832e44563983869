// Drivers of the recursive methods: they trace the rays of a Scattering and combine the light that comes back.
// slack: rounding error of the light that has met the surface so far (check.h).

FN bool canScatter(IN(Hit) h) { return h.depth > R(0.5); }

FN Payload black() { return payloadUnpolarized(splat3(R(0.0))); }

// Sends light to the camera through the medium that the ray came through. sDir: s direction of the surface.
FN Payload sendToCamera(IN(Hit) h, SurfaceLight toCamera, real3 sDir, real3 slack) {
  SurfaceLight light = toCamera;
  if (kEffectAbsorption) light = lightScale(light, mediumTransmittance(h));
  Payload sent = payloadFromSurface(light, h.d, sDir);
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}

// Light of the reflected ray and the highlight, behind the surface's reflection.
FN_INLINE SurfaceLight reflectedLight(IN(Hit) h, IN(Scattering) s, real3 highlight, real3 sDir, INOUT(real3) slack) {
  Payload returned = traceRay(originAbove(h), s.reflected, h.depth - R(1.0));
  if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(returned, s.reflected));
  SurfaceLight arriving = lightAtSurface(returned, s.reflected, sDir);
  return lightThroughInterface(s.reflection, lightAdd(arriving, lightUnpolarized(highlight)));
}

// Light of the transmitted ray, behind the surface's transmission.
FN_INLINE SurfaceLight transmittedLight(IN(Hit) h, IN(Scattering) s, real3 sDir, INOUT(real3) slack) {
  Payload returned = traceRay(originBelow(h), s.transmitted, h.depth - R(1.0));
  if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(returned, s.transmitted));
  return lightThroughInterface(s.transmission, lightAtSurface(returned, s.transmitted, sDir));
}

// Light that one facet reflects toward the camera, in the frame of the surface.
FN SurfaceLight facetLight(IN(Hit) h, IN(Material) m, IN(Facet) facet, real3 sDir, INOUT(real3) slack) {
  Payload returned = traceRay(originAbove(h), facet.mirror, h.depth - R(1.0) + kBehindRough);
  if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(returned, facet.mirror));
  FresnelTerms f = opaqueTerms(facet.c, m, h.material);
  real3 facetS = surfaceS(h.d, facet.normal);
  SurfaceLight reflected = lightThroughInterface(f, lightAtSurface(returned, facet.mirror, facetS));
  Payload sent = payloadFromSurface(lightScale(reflected, splat3(facet.weight)), h.d, facetS);
  return lightAtSurface(sent, h.d, sDir);
}

FN SurfaceLight roughReflectedLight(IN(Hit) h, IN(Material) m, real3 sDir, INOUT(real3) slack) {
  SurfaceLight sum = lightUnpolarized(splat3(R(0.0)));
  for (uint i = 0u; i < kFacets; ++i) {
    Facet facet = sampleFacet(h, camera.facets[i].x, camera.facets[i].y);
    if (facet.weight > R(0.0)) sum = lightAdd(sum, facetLight(h, m, facet, sDir, slack));
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
