// Radiance of the environment for a ray in direction d that leaves the scene.
FN real3 environmentRadiance(real3 d) {
  if (!kEffectEnvironmentMap || camera.environmentSize == 0) return camera.environment;
  TexelPosition p = environmentTexelPosition(d, real(camera.environmentSize));
  int row = camera.environmentSize + 2;
  int at = int(p.y) * row + int(p.x);
  return bilinear(environmentTexels[at], environmentTexels[at + 1], environmentTexels[at + row],
                  environmentTexels[at + row + 1], p.fx, p.fy);
}

// The same under a clear sky: a map contains its radiance already, a constant is its mean. degree: of linear
// polarization along the s direction of a surface whose normal points to the sun.
FN real3 skyRadiance(real3 d, OUT(real) degree) {
  real cosine = dot3(d, camera.sun);
  degree = rayleighDegree(cosine, camera.skyDegree);
  real3 radiance = environmentRadiance(d);
  if (camera.environmentSize == 0 && dot3(camera.sun, camera.sun) > R(0.0)) radiance = radiance * rayleighPhase(cosine);
  return radiance;
}
