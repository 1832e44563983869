// A loop of perfect mirrors. Inputs too large to pass by value: GIVEN_PARAMETER and GIVEN are the index into the
// buffer in GLSL, a reference in C++.

FN IterativeOut iterativeProbe(GIVEN_PARAMETER(IterativeIn)) {
  real3 d = GIVEN.d;
  Stokes light = stokesUnpolarized(splat3(R(1.0)));
  light.s1 = splat3(GIVEN.light.x);
  light.s2 = splat3(GIVEN.light.y);
  light.s3 = splat3(GIVEN.light.z);
  int count = int(GIVEN.count);
  real3 x;
  real3 y;
  real cos2;
  real sin2;
  for (int i = 0; i < count; ++i) {
    real3 n = GIVEN.n[i];
    n = n * (R(0.0) - signNotZero(dot3(d, n)));
    // The rays of malus run against the light; perpendicular to both is the same s.
    real3 s = sDirection(d, n);
    canonicalFrame(d, x, y);
    frameRotation(s, x, y, cos2, sin2);
    light = rotateStokes(light, cos2, sin2);
    light = stokesInterface(light, splat3(R(1.0)), splat3(R(1.0)), splat3(R(-1.0)), splat3(R(0.0)));
    d = mirrorDirection(d, n, clampUnit(R(0.0) - dot3(d, n)));
    canonicalFrame(d, x, y);
    frameRotation(s, x, y, cos2, sin2);
    light = rotateStokes(light, cos2, R(0.0) - sin2);
  }
  IterativeOut r;
  r.s0 = light.s0.x;
  r.s1 = light.s1.x;
  r.s2 = light.s2.x;
  r.s3 = light.s3.x;
  r.last = d;
  return r;
}
