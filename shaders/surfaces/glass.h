// A clear glass interface: reflects and transmits, both branches followed.
FN Payload shadeGlass(Hit h, Material m) {
  if (h.depth < R(0.5)) return payloadSource(splat3(R(0.0)));
  real n1 = h.outside ? m.outsideEta : m.eta.y;
  real n2 = h.outside ? m.eta.y : m.outsideEta;
  real3 through = refractedDirection(h.d, h.normal, h.c, n1, n2);
  bool total = refractionTerms(h.c, n1, n2).total;
  if (!total && dot3(through, h.face) >= R(0.0)) {
    // The interpolated normal would send the light back out: take the face's.
    h.normal = h.face;
    h.c = clampUnit(R(0.0) - dot3(h.d, h.face));
    through = refractedDirection(h.d, h.normal, h.c, n1, n2);
    total = refractionTerms(h.c, n1, n2).total;
  }
  Factors f = dielectricFactors(h.c, n1, n2);
  real3 mirror = mirrorDirection(h.d, h.normal, h.c);
  real3 s = surfaceS(h.d, h.normal);
  Payload returned = traceRay(originAbove(h), mirror, h.depth - R(1.0));
  real3 highlight = directLight(h, m, mirror).highlight;
  real3 slack = highlight * (R(8.0) * kUnitRoundoff);
  if (kCheckNumerics) slack = slack + slackOf(payloadStokes(returned, mirror));
  Light arriving = lightAdd(lightReceive(returned, mirror, s), lightUnpolarized(highlight));
  Light toEye = lightReflect(f, arriving);
  if (!total) {
    Payload below = traceRay(originBelow(h), through, h.depth - R(1.0));
    if (kCheckNumerics) slack = slack + slackOf(payloadStokes(below, through));
    toEye = lightAdd(toEye, lightTransmit(f, lightReceive(below, through, s)));
  }
  Payload sent = payloadSend(toEye, h.d, s);
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}
