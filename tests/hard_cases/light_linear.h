// Light of `stokes-linear`, for handOverProbe.
FN SurfaceLight lightOf(real3 radiance, real3 polarization) {
  SurfaceLight l;
  l.s0 = radiance;
  l.s1 = radiance * polarization.x;
  l.s2 = radiance * polarization.y;
  return l;
}
FN real3 lightTotal(SurfaceLight l) { return l.s0; }
