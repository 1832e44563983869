// A clear glass interface: reflects and transmits, both branches followed.
FN Payload shadeGlass(Hit h, IN(Material) m) {
  if (h.depth < R(0.5)) return payloadUnpolarized(splat3(R(0.0)));
  Refraction way = refractAtGlass(h, m);
  FresnelTerms f = glassTerms(h.c, way.n1, way.n2, h.material);
  real3 mirror = mirrorDirection(h.d, h.normal, h.c);
  real3 s = surfaceS(h.d, h.normal);
  Payload returned = traceRay(originAbove(h), mirror, h.depth - R(1.0));
  real3 highlight = directLight(h, m, mirror).highlight;
  real3 slack = highlight * (R(8.0) * kUnitRoundoff);
  if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(returned, mirror));
  SurfaceLight arriving = lightAdd(lightAtSurface(returned, mirror, s), lightUnpolarized(highlight));
  SurfaceLight toCamera = lightReflect(f, arriving);
  if (!way.total) {
    Payload below = traceRay(originBelow(h), way.through, h.depth - R(1.0));
    if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(below, way.through));
    SurfaceLight fromBelow = lightAtSurface(below, way.through, s);
#if MALUS_EFFECT_COATINGS
    if (hasFilm(h.material))
      fromBelow = lightReflect(filmTransmissionTerms(h.c, way.n1, extras[h.material].filmEta,
                                                     extras[h.material].roundTripPhase, splat3(way.n2)),
                               fromBelow);
    else
#endif
      fromBelow = lightTransmit(f, fromBelow);
    toCamera = lightAdd(toCamera, fromBelow);
  }
  return sendToCamera(h, m, toCamera, s, slack);
}
