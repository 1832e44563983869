// Surfaces that reflect and let nothing through: what lies under the interface leaves through it, what
// comes along the mirror direction is reflected (the paper's section 2, for every method).

#if MALUS_EFFECT_ROUGHNESS
// Light that the facets reflect toward the eye, in the frame of the surface's s.
FN Light facetLight(IN(Hit) h, IN(Material) m, real3 s, INOUT(real3) slack) {
  Light sum = lightUnpolarized(splat3(R(0.0)));
  for (uint i = 0u; i < kFacets; ++i) {
    Facet facet = facetOf(h, i);
    if (facet.weight <= R(0.0)) continue;
    Payload returned = traceRay(originAbove(h), facet.mirror, h.depth - R(1.0) + kBehindRough);
    if (kCheckNumerics) slack = slack + slackOf(payloadStokes(returned, facet.mirror));
    Factors f = opaqueFactors(facet.c, m, h.material);
    real3 facetS = surfaceS(h.d, facet.normal);
    Light reflected = lightReflect(f, lightReceive(returned, facet.mirror, facetS));
    // From the facet's s direction to the surface's.
    Payload sent = payloadSend(lightScale(reflected, splat3(facet.weight)), h.d, facetS);
    sum = lightAdd(sum, lightReceive(sent, h.d, s));
  }
  return sum;
}
#endif

FN Payload shadeOpaque(IN(Hit) h, IN(Material) m, Factors f) {
  real3 mirror = mirrorDirection(h.d, h.normal, h.c);
  DirectLight direct = directLight(h, m, mirror);
  Light toEye = lightLeave(f, direct.diffuse);
  real3 slack = (direct.diffuse + direct.highlight) * (R(8.0) * kUnitRoundoff);
  real3 s = surfaceS(h.d, h.normal);
  if (h.depth > R(0.5)) {
#if MALUS_EFFECT_ROUGHNESS
    if (isRough(h)) {
      toEye = lightAdd(toEye, lightReflect(f, lightUnpolarized(direct.highlight)));
      toEye = lightAdd(toEye, facetLight(h, m, s, slack));
    } else
#endif
    {
      Payload returned = traceRay(originAbove(h), mirror, h.depth - R(1.0));
      if (kCheckNumerics) slack = slack + slackOf(payloadStokes(returned, mirror));
      Light arriving = lightReceive(returned, mirror, s);
      arriving = lightAdd(arriving, lightUnpolarized(direct.highlight));
      toEye = lightAdd(toEye, lightReflect(f, arriving));
    }
  }
  return sendToEye(h, m, toEye, s, slack);
}
