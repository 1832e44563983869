// Light of the methods that carry s and p powers, for handOverProbe.
FN SurfaceLight lightOf(real3 radiance, real3 polarization) {
  SurfaceLight l;
  l.s = radiance * ((R(1.0) + polarization.x) * R(0.5));
  l.p = radiance * ((R(1.0) - polarization.x) * R(0.5));
  return l;
}
FN real3 lightTotal(SurfaceLight l) { return l.s + l.p; }
