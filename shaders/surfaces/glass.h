// A clear glass interface: reflects and transmits, both branches followed.
FN Payload shadeGlass(Hit h, Material m) {
  if (h.depth < R(0.5)) return payloadSource(splat3(R(0.0)));
  real n1 = h.outside ? m.outsideEta : m.eta.y;
  real n2 = h.outside ? m.eta.y : m.outsideEta;
  real3 through = refractedDirection(h.d, h.normal, h.c, n1, n2);
  if (dot3(through, h.face) >= R(0.0)) {
    // The interpolated normal would send the light back out: take the face's.
    h.normal = h.face;
    h.c = clampUnit(R(0.0) - dot3(h.d, h.face));
    through = refractedDirection(h.d, h.normal, h.c, n1, n2);
  }
  Factors f = dielectricFactors(h.c, n1, n2);
  real3 mirror = mirrorDirection(h.d, h.normal, h.c);
  real3 s = surfaceS(h.d, h.normal);
  Light arriving = lightReceive(traceRay(originAbove(h), mirror, h.depth - R(1.0)), mirror, s);
  arriving = lightAdd(arriving, lightUnpolarized(directLight(h, m, mirror).highlight));
  Light toEye = lightReflect(f, arriving);
  if (!refractionTerms(h.c, n1, n2).total) {
    Light below = lightReceive(traceRay(originBelow(h), through, h.depth - R(1.0)), through, s);
    toEye = lightAdd(toEye, lightTransmit(f, below));
  }
  return payloadSend(toEye, h.d, s);
}
