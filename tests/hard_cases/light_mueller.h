// Light of the methods that carry Stokes vectors, for handOverProbe.
FN SurfaceLight lightOf(real3 radiance, real3 polarization) {
  SurfaceLight l;
  l.stokes.s0 = radiance;
  l.stokes.s1 = radiance * polarization.x;
  l.stokes.s2 = radiance * polarization.y;
  l.stokes.s3 = radiance * polarization.z;
  return l;
}
FN real3 lightTotal(SurfaceLight l) { return l.stokes.s0; }
