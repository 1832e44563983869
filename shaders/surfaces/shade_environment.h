// Recursive methods: light of the environment along a ray in direction d that leaves the scene.
FN Payload shadeEnvironment(real3 d, real depth) {
  real3 slack = splat3(R(0.0));
  Payload sent;
  if (kEffectSky) {
    real degree;
    real3 radiance = skyRadiance(d, degree);
    sent = payloadUnpolarized(radiance);
    mask polarized = lessR(R(0.0), degree);
    if (anyM(polarized)) {
      SurfaceLight light = lightPolarized(radiance, degree);
      sent = SELECT(polarized, payloadFromSurface(light, d, surfaceS(d, camera.sun)), sent);
    }
    slack = radiance * (R(8.0) * kUnitRoundoff);
  } else {
    sent = payloadUnpolarized(environmentRadiance(d));
  }
  if (kCheckNumerics) checkSent(environmentHit(d, depth), sent, slack);
  return sent;
}
