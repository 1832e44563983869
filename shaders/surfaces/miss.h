// A ray that leaves the scene.
FN Payload shadeMiss(real3 d, real depth) {
  Payload sent = payloadSource(environmentRadiance(d));
  if (kCheckNumerics) checkSent(missedHit(d, depth), sent, splat3(R(0.0)));
  return sent;
}
