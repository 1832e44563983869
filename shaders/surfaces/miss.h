// A ray that leaves the scene.
FN Payload shadeEnvironment(real3 d, real depth) {
#if MALUS_EFFECT_SKY
  real degree;
  real3 radiance = skyRadiance(d, degree);
  Payload sent = payloadUnpolarized(radiance);
  if (degree > R(0.0)) sent = payloadFromSurface(lightPolarized(radiance, degree), d, surfaceS(d, camera.sun));
  if (kCheckNumerics) checkSent(environmentHit(d, depth), sent, radiance * (R(8.0) * kUnitRoundoff));
#else
  Payload sent = payloadUnpolarized(environmentRadiance(d));
  if (kCheckNumerics) checkSent(environmentHit(d, depth), sent, splat3(R(0.0)));
#endif
  return sent;
}
