// Gives off unpolarized light on the side of its normal; reflects nothing.
FN Payload shadeEmitter(Hit h, Material m) {
  real3 none = splat3(R(0.0));
  Payload sent = payloadSource(select3(h.outside, m.radiance, none));
  if (kCheckNumerics) checkSent(h, sent, none);
  return sent;
}
