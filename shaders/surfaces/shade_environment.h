// Recursive methods: light of the environment along a ray in direction d that leaves the scene.
FN Payload shadeEnvironment(real3 d, real depth) {
  real3 slack = splat3(R(0.0));
  Payload sent;
  if (kEffectSky) {
    real degree;
    real3 radiance = skyRadiance(d, degree);
    sent = payloadUnpolarized(radiance);
    if (degree > R(0.0)) sent = payloadFromSurface(lightPolarized(radiance, degree), d, surfaceS(d, camera.sun));
    slack = radiance * (R(8.0) * kUnitRoundoff);
  } else {
    sent = payloadUnpolarized(environmentRadiance(d));
  }
  if (kCheckNumerics) checkSent(environmentHit(d, depth), sent, slack);
  return sent;
}
