// A ray that leaves the scene.
FN Payload shadeMiss(real3 d, real depth) {
#if MALUS_EFFECT_SKY
  real degree;
  real3 radiance = skyRadiance(d, degree);
  Payload sent = payloadSource(radiance);
  if (degree > R(0.0)) sent = payloadSend(lightPolarized(radiance, degree), d, surfaceS(d, frame.sun));
  if (kCheckNumerics) checkSent(missedHit(d, depth), sent, radiance * (R(8.0) * kUnitRoundoff));
#else
  Payload sent = payloadSource(environmentRadiance(d));
  if (kCheckNumerics) checkSent(missedHit(d, depth), sent, splat3(R(0.0)));
#endif
  return sent;
}
