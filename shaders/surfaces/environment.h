// Whether rays that leave the scene bring nothing.
FN bool isEnvironmentBlack() {
  if (kEffectEnvironmentMap && camera.environmentSize != 0) return false;
  return camera.environment.x == 0.0 && camera.environment.y == 0.0 && camera.environment.z == 0.0;
}

// Radiance of the environment for a ray in direction d that leaves the scene.
FN real3 environmentRadiance(real3 d) {
  if (!kEffectEnvironmentMap || camera.environmentSize == 0) return camera.environment;
  TexelPosition p = environmentTexelPosition(d, real(camera.environmentSize));
  real right = p.x + R(1.0);
  real below = p.y + R(1.0);
  return bilinear(environmentTexel(p.x, p.y), environmentTexel(right, p.y), environmentTexel(p.x, below),
                  environmentTexel(right, below), p.fx, p.fy);
}

// The same under a clear sky: a map contains its radiance already, a constant is its mean. degree: of linear
// polarization along the s direction of a surface whose normal points to the sun.
FN real3 skyRadiance(real3 d, OUT(real) degree) {
  real cosine = dot3(d, camera.sun);
  degree = rayleighDegree(cosine, camera.skyDegree);
  real3 radiance = environmentRadiance(d);
  if (camera.environmentSize != 0) return radiance;
  return select3(lessR(R(0.0), dot3(camera.sun, camera.sun)), radiance * rayleighPhase(cosine), radiance);
}
