// Bare Lambert: unpolarized diffuse light, no interface.
FN Payload shadeLambert(Hit h, Material m) {
  Payload sent = payloadSource(directLight(h, m, h.normal).diffuse);
  if (kCheckNumerics) checkSent(h, sent, splat3(R(0.0)));
  return sent;
}
