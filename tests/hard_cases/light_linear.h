// Light of `stokes-linear`, for handOverProbe.
FN Light lightOf(real3 radiance, real3 polarization) {
  Light l;
  l.s0 = radiance;
  l.s1 = radiance * polarization.x;
  l.s2 = radiance * polarization.y;
  return l;
}
FN real3 lightTotal(Light l) { return l.s0; }
