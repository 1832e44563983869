// A polarizer sheet or a wave plate.
FN Payload shadeSheet(IN(Hit) h, IN(Material) m) {
  if (h.depth < R(0.5)) return payloadSource(splat3(R(0.0)));
  real3 s = surfaceS(h.d, sheetNormal(h));
  Payload returned = traceRay(originBelow(h), h.d, h.depth - R(1.0));
  real3 slack = splat3(R(0.0));
  if (kCheckNumerics) slack = slackOf(payloadStokes(returned, h.d));
  Light toEye = lightReflect(sheetFactors(h.material), lightReceive(returned, h.d, s));
  return sendToEye(h, m, toEye, s, slack);
}
