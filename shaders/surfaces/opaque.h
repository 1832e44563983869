// Surfaces that reflect and let nothing through: what lies under the interface leaves through it, what
// comes along the mirror direction is reflected (the paper's section 2, for every method).

#if MALUS_EFFECT_ROUGHNESS
// Light that the facets reflect toward the eye, in the frame of the surface's s.
FN SurfaceLight facetLight(IN(Hit) h, IN(Material) m, real3 s, INOUT(real3) slack) {
  SurfaceLight sum = lightUnpolarized(splat3(R(0.0)));
  for (uint i = 0u; i < kFacets; ++i) {
    Facet facet = sampleFacet(h, i);
    if (facet.weight <= R(0.0)) continue;
    Payload returned = traceRay(originAbove(h), facet.mirror, h.depth - R(1.0) + kBehindRough);
    if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(returned, facet.mirror));
    FresnelTerms f = opaqueTerms(facet.c, m, h.material);
    real3 facetS = surfaceS(h.d, facet.normal);
    SurfaceLight reflected = lightReflect(f, lightAtSurface(returned, facet.mirror, facetS));
    // From the facet's s direction to the surface's.
    Payload sent = payloadFromSurface(lightScale(reflected, splat3(facet.weight)), h.d, facetS);
    sum = lightAdd(sum, lightAtSurface(sent, h.d, s));
  }
  return sum;
}
#endif

FN Payload shadeOpaque(IN(Hit) h, IN(Material) m, FresnelTerms f) {
  real3 mirror = mirrorDirection(h.d, h.normal, h.c);
  DirectLight direct = directLight(h, m, mirror);
  SurfaceLight toCamera = lightFromBelow(f, direct.diffuse);
  real3 slack = (direct.diffuse + direct.highlight) * (R(8.0) * kUnitRoundoff);
  real3 s = surfaceS(h.d, h.normal);
  if (h.depth > R(0.5)) {
#if MALUS_EFFECT_ROUGHNESS
    if (isRough(h)) {
      toCamera = lightAdd(toCamera, lightReflect(f, lightUnpolarized(direct.highlight)));
      toCamera = lightAdd(toCamera, facetLight(h, m, s, slack));
    } else
#endif
    {
      Payload returned = traceRay(originAbove(h), mirror, h.depth - R(1.0));
      if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(returned, mirror));
      SurfaceLight arriving = lightAtSurface(returned, mirror, s);
      arriving = lightAdd(arriving, lightUnpolarized(direct.highlight));
      toCamera = lightAdd(toCamera, lightReflect(f, arriving));
    }
  }
  return sendToCamera(h, m, toCamera, s, slack);
}
