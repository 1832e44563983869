// Light handed over in one method, whose file comes before this one.

FN HandOverOut handOverProbe(GIVEN_PARAMETER(HandOverIn)) {
  Payload p = payloadFromSurface(lightOf(GIVEN.radiance, GIVEN.light), GIVEN.d, GIVEN.from);
  Stokes s = payloadStokes(p, GIVEN.d);
  HandOverOut r;
  r.s0 = s.s0;
  r.s1 = s.s1;
  r.s2 = s.s2;
  r.s3 = s.s3;
  r.received = lightTotal(lightAtSurface(p, GIVEN.d, GIVEN.to));
  return r;
}
