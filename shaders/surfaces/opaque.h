// Surfaces that reflect and let nothing through: what lies under the interface leaves through it, what
// comes along the mirror direction is reflected (the paper's section 2, for every method).
FN Payload shadeOpaque(Hit h, Material m, Factors f) {
  real3 mirror = mirrorDirection(h.d, h.normal, h.c);
  DirectLight direct = directLight(h, m, mirror);
  Light toEye = lightLeave(f, direct.diffuse);
  real3 slack = (direct.diffuse + direct.highlight) * (R(8.0) * kUnitRoundoff);
  real3 s = surfaceS(h.d, h.normal);
  if (h.depth > R(0.5)) {
    Payload returned = traceRay(originAbove(h), mirror, h.depth - R(1.0));
    if (kCheckNumerics) slack = slack + slackOf(payloadStokes(returned, mirror));
    Light arriving = lightReceive(returned, mirror, s);
    arriving = lightAdd(arriving, lightUnpolarized(direct.highlight));
    toEye = lightAdd(toEye, lightReflect(f, arriving));
  }
  Payload sent = payloadSend(toEye, h.d, s);
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}
