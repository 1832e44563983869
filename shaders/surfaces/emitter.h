// Gives off unpolarized light on the side of its normal; reflects nothing.
FN Payload shadeEmitter(Hit h, Material m) {
  real3 none = splat3(R(0.0));
  return payloadSource(select3(h.outside, m.radiance, none));
}
