// A polarizer sheet or a wave plate.
FN Payload shadeSheet(IN(Hit) h, IN(Material) m) {
  if (h.depth < R(0.5)) return payloadSource(splat3(R(0.0)));
  real3 s = surfaceS(h.d, sheetNormal(h));
  Payload returned = traceRay(originBelow(h), h.d, h.depth - R(1.0));
  real3 slack = splat3(R(0.0));
  if (kCheckNumerics) slack = slackOf(payloadStokes(returned, h.d));
  Light toEye = lightReflect(sheetFactors(h.material), lightReceive(returned, h.d, s));
#if MALUS_EFFECT_ABSORPTION
  toEye = lightScale(toEye, mediumTransmittance(h, m));
#endif
  Payload sent = payloadSend(toEye, h.d, s);
  if (kCheckNumerics) checkSent(h, sent, slack);
  return sent;
}
