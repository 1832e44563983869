// Light passed between two surfaces in one method, whose file is included before this one.

FN HandOverOut handOverProbe(GIVEN_PARAMETER(HandOverIn)) {
  Stokes sent = stokesUnpolarized(GIVEN.radiance);
  sent.s1 = GIVEN.radiance * GIVEN.light.x;
  sent.s2 = GIVEN.radiance * GIVEN.light.y;
  sent.s3 = GIVEN.radiance * GIVEN.light.z;
  Payload p = payloadFromSurface(lightFromStokes(sent), GIVEN.d, GIVEN.from);
  Stokes s = payloadStokes(p, GIVEN.d);
  HandOverOut r;
  r.s0 = s.s0;
  r.s1 = s.s1;
  r.s2 = s.s2;
  r.s3 = s.s3;
  r.received = lightRadiance(lightAtSurface(p, GIVEN.d, GIVEN.to));
  return r;
}
