// Light passed between two surfaces in one method, whose file is included before this one.

FN HandOverOut handOverProbe(GIVEN_PARAMETER(HandOverIn)) {
  // Of radiance 1 first, so that every colour has the same polarization to the last bit.
  Stokes sent = stokesUnpolarized(splat3(R(1.0)));
  sent.s1 = splat3(GIVEN.light.x);
  sent.s2 = splat3(GIVEN.light.y);
  sent.s3 = splat3(GIVEN.light.z);
  SurfaceLight light = lightScale(lightFromStokes(sent), GIVEN.radiance);
  Payload p = payloadFromSurface(light, GIVEN.d, GIVEN.from);
  Stokes s = payloadStokes(p, GIVEN.d);
  HandOverOut r;
  r.s0 = s.s0;
  r.s1 = s.s1;
  r.s2 = s.s2;
  r.s3 = s.s3;
  r.received = lightRadiance(lightAtSurface(p, GIVEN.d, GIVEN.to));
  return r;
}
