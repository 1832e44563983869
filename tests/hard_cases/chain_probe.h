// A chain in one method, whose file is included before this one.

// |(S1, S2, S3)| - S0, computed by quotients, whose squares neither overflow nor underflow. Under 1e-30 a float's S1 to
// S3 have lost their bits to the end of its range.
FN real polarizationExcess(Stokes s) {
  real s0 = maxR(s.s0.x, R(1e-30));
  real a = s.s1.x / s0;
  real b = s.s2.x / s0;
  real c = s.s3.x / s0;
  return selectR(lessR(s.s0.x, R(1e-30)), R(0.0), (sqrtR(a * a + b * b + c * c) - R(1.0)) * s0);
}

FN ChainOut chainProbe(GIVEN_PARAMETER(ChainIn)) {
  int count = int(GIVEN.count);
  // Trace the rays from the camera.
  real3 d[65];
  real c[64];
  d[0] = GIVEN.d;
  for (int i = 0; i < count; ++i) {
    real3 n = GIVEN.bounces[i].n;
    n = n * (R(0.0) - signNotZero(dot3(d[i], n)));
    c[i] = clampUnit(R(0.0) - dot3(d[i], n));
    if (GIVEN.bounces[i].kind > R(1.5))
      d[i + 1] = refractedDirection(d[i], n, c[i], GIVEN.bounces[i].n1, GIVEN.bounces[i].n2);
    else
      d[i + 1] = mirrorDirection(d[i], n, c[i]);
  }
  // Follow the light back to the camera.
  ChainOut r;
  r.gained = R(0.0);
  r.grown = R(0.0);
  Payload p = payloadUnpolarized(splat3(GIVEN.radiance));
  for (int i = count - 1; i >= 0; --i) {
    real n1 = GIVEN.bounces[i].n1;
    real n2 = GIVEN.bounces[i].n2;
    real kind = GIVEN.bounces[i].kind;
    real3 s = surfaceS(d[i], GIVEN.bounces[i].n);
    Stokes before = payloadStokes(p, d[i + 1]);
    SurfaceLight arriving = lightAtSurface(p, d[i + 1], s);
    FresnelTerms f;
    if (kind > R(0.5) && kind < R(1.5))
      f = conductorTerms(c[i], n1, splat3(n2), splat3(GIVEN.bounces[i].k2), splat3(n2 - n1));
    else
      f = dielectricTerms(c[i], n1, n2, n2 - n1);
    SurfaceLight sent;
    if (kind > R(1.5))
      sent = lightThroughInterface(transmissionTerms(f), arriving);
    else
      sent = lightThroughInterface(f, arriving);
    p = payloadFromSurface(sent, d[i], s);
    Stokes after = payloadStokes(p, d[i]);
    if (before.s0.x > R(1e-30)) {
      r.gained = maxR(r.gained, (polarizationExcess(after) - maxR(polarizationExcess(before), R(0.0))) / before.s0.x);
      r.grown = maxR(r.grown, (after.s0.x - before.s0.x) / before.s0.x);
    }
  }
  Stokes seen = payloadStokes(p, d[0]);
  r.s0 = seen.s0.x;
  r.s1 = seen.s1.x;
  r.s2 = seen.s2.x;
  r.s3 = seen.s3.x;
  r.last = d[count];
  return r;
}
