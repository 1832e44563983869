// A clear glass interface: reflects and transmits, both branches followed.
FN Payload shadeGlass(Hit h, IN(Material) m) {
  if (h.depth < R(0.5)) return payloadSource(splat3(R(0.0)));
  GlassWay way = glassWay(h, m);
  Factors f = glassFactors(h.c, way.n1, way.n2, h.material);
  real3 mirror = mirrorDirection(h.d, h.normal, h.c);
  real3 s = surfaceS(h.d, h.normal);
  Payload returned = traceRay(originAbove(h), mirror, h.depth - R(1.0));
  real3 highlight = directLight(h, m, mirror).highlight;
  real3 slack = highlight * (R(8.0) * kUnitRoundoff);
  if (kCheckNumerics) slack = slack + slackOf(payloadStokes(returned, mirror));
  Light arriving = lightAdd(lightReceive(returned, mirror, s), lightUnpolarized(highlight));
  Light toEye = lightReflect(f, arriving);
  if (!way.total) {
    Payload below = traceRay(originBelow(h), way.through, h.depth - R(1.0));
    if (kCheckNumerics) slack = slack + slackOf(payloadStokes(below, way.through));
    Light fromBelow = lightReceive(below, way.through, s);
#if MALUS_EFFECT_COATINGS
    if (hasFilm(h.material))
      fromBelow = lightReflect(
          filmThroughFactors(h.c, way.n1, extras[h.material].filmEta, extras[h.material].filmTurns, splat3(way.n2)),
          fromBelow);
    else
#endif
      fromBelow = lightTransmit(f, fromBelow);
    toEye = lightAdd(toEye, fromBelow);
  }
  return sendToEye(h, m, toEye, s, slack);
}
