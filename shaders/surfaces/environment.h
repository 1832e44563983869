// What a ray sees that leaves the scene. The octahedral map has a border of one texel that repeats what
// lies across its edges, so bilinear interpolation needs no special case.
FN real3 environmentRadiance(real3 d) {
#if !MALUS_EFFECT_ENVIRONMENT_MAP
  return camera.environment;
#else
  if (camera.environmentSize == 0) return camera.environment;
  real u;
  real v;
  octahedralFromDirection(d, u, v);
  real size = real(camera.environmentSize);
  real x = u * size + R(0.5);
  real y = v * size + R(0.5);
  int ix = int(x);
  int iy = int(y);
  if (ix > camera.environmentSize) ix = camera.environmentSize;
  if (iy > camera.environmentSize) iy = camera.environmentSize;
  real fx = x - real(ix);
  real fy = y - real(iy);
  int row = camera.environmentSize + 2;
  int at = iy * row + ix;
  real3 top = environmentTexels[at] * (R(1.0) - fx) + environmentTexels[at + 1] * fx;
  real3 bottom = environmentTexels[at + row] * (R(1.0) - fx) + environmentTexels[at + row + 1] * fx;
  return top * (R(1.0) - fy) + bottom * fy;
#endif
}

#if MALUS_EFFECT_SKY
// The same under a clear sky: a picture has its radiance already, a constant is its mean. degree: of linear
// polarization along the s direction of a surface whose normal points to the sun.
FN real3 skyRadiance(real3 d, OUT(real) degree) {
  real cosine = dot3(d, camera.sun);
  degree = rayleighDegree(cosine, camera.skyDegree);
  real3 radiance = environmentRadiance(d);
  if (camera.environmentSize == 0 && dot3(camera.sun, camera.sun) > R(0.0)) radiance = radiance * rayleighPhase(cosine);
  return radiance;
}
#endif
