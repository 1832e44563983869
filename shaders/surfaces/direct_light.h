// Light that point lights and the environment's fill send to the eye by way of a surface, before the
// interface that it leaves through. Every surface blocks a point light.

struct DirectLight {
  real3 diffuse;    // radiance of the Lambert layer
  real3 highlight;  // radiance in the mirror direction
};

// Transmittance of the material's interface, mean of s and p, for light at an angle with cosine c.
FN real3 enteringTransmittance(IN(Material) m, uint index, real c) {
  if (m.kind == kPaint || m.kind == kMetal) return meanTransmittance(opaqueTerms(c, m, index));
  return splat3(R(1.0));
}

FN real3 environmentIrradiance(real3 n) {
  real3 e;
  e.x = irradiancePolynomial(n, camera.irradiance[0].x, camera.irradiance[1].x, camera.irradiance[2].x,
                             camera.irradiance[3].x, camera.irradiance[4].x, camera.irradiance[5].x,
                             camera.irradiance[6].x, camera.irradiance[7].x, camera.irradiance[8].x);
  e.y = irradiancePolynomial(n, camera.irradiance[0].y, camera.irradiance[1].y, camera.irradiance[2].y,
                             camera.irradiance[3].y, camera.irradiance[4].y, camera.irradiance[5].y,
                             camera.irradiance[6].y, camera.irradiance[7].y, camera.irradiance[8].y);
  e.z = irradiancePolynomial(n, camera.irradiance[0].z, camera.irradiance[1].z, camera.irradiance[2].z,
                             camera.irradiance[3].z, camera.irradiance[4].z, camera.irradiance[5].z,
                             camera.irradiance[6].z, camera.irradiance[7].z, camera.irradiance[8].z);
  return e;
}

FN DirectLight directLight(IN(Hit) h, IN(Material) m, real3 mirror) {
  DirectLight sum;
  sum.diffuse = splat3(R(0.0));
  sum.highlight = splat3(R(0.0));
#if MALUS_EFFECT_POINT_LIGHTS || MALUS_EFFECT_AMBIENT
  bool isDiffuse = maxR(m.albedo.x, maxR(m.albedo.y, m.albedo.z)) > R(0.0);
#endif
#if MALUS_EFFECT_POINT_LIGHTS
  bool isGlossy = m.highlightStrength > R(0.0) && h.depth > R(0.5);
  if (isDiffuse || isGlossy) {
    for (int i = 0; i < camera.lightCount; ++i) {
      real3 origin = originAbove(h);
      real3 toLight = lights[i].position - origin;
      real distanceSq = dot3(toLight, toLight);
      real distanceToLight = sqrtR(distanceSq);
      real3 l = toLight * (R(1.0) / distanceToLight);
      real c = dot3(h.normal, l);
      if (c <= R(0.0) || dot3(h.face, l) <= R(0.0)) continue;
#if MALUS_EFFECT_HIGHLIGHTS
      real lobe = isGlossy ? m.highlightStrength * phongLobe(mirror, l, m.highlightExponent) : R(0.0);
#else
      real lobe = R(0.0);
#endif
      if (!isDiffuse && lobe <= R(0.0)) continue;
#if MALUS_EFFECT_SHADOWS
      if (camera.shadows != 0u && !visible(origin, l, distanceToLight)) continue;
#endif
      real3 arriving = lights[i].intensity * (R(1.0) / distanceSq);
#if MALUS_EFFECT_ABSORPTION
      arriving = arriving * transmittanceOver(mediumAbsorption(h, m), distanceToLight);
#endif
      if (isDiffuse)
        sum.diffuse = sum.diffuse +
                      lambertRadiance(m.albedo, arriving * c, enteringTransmittance(m, h.material, minR(c, R(1.0))));
      sum.highlight = sum.highlight + arriving * lobe;
    }
  }
#endif
#if MALUS_EFFECT_AMBIENT
  if (isDiffuse && camera.ambientIrradiance > R(0.0))
    sum.diffuse = sum.diffuse + lambertRadiance(m.albedo, environmentIrradiance(h.normal) * camera.ambientIrradiance,
                                                m.hemisphereTransmittance);
#endif
  sum.diffuse = sum.diffuse * m.basicScale;
  sum.highlight = sum.highlight * m.basicScale;
  return sum;
}
