// A polarizer sheet or a wave plate.
FN Payload shadePolarizingElement(IN(Hit) h, IN(Material) m) {
  if (h.depth < R(0.5)) return payloadUnpolarized(splat3(R(0.0)));
  real3 s = surfaceS(h.d, polarizingElementNormal(h));
  Payload returned = traceRay(originBelow(h), h.d, h.depth - R(1.0));
  real3 slack = splat3(R(0.0));
  if (kCheckNumerics) slack = roundingSlack(payloadStokes(returned, h.d));
  SurfaceLight toCamera = lightReflect(polarizingElementTerms(h.material), lightAtSurface(returned, h.d, s));
  return sendToCamera(h, m, toCamera, s, slack);
}
