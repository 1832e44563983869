// Light of the lights and of the environment that a surface scatters toward the camera, before the interface that it
// leaves through.

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

// Adds one point light, by a shadow ray if it can contribute. isFar: it stands for a light at infinity.
FN void addPointLight(INOUT(DirectLight) sum, IN(Hit) h, IN(Material) m, IN(PointLight) light, mask isFar,
                      real3 reflected, mask diffuse, mask glossy) {
  LightSample s = sampleLight(h, m, light, reflected, diffuse, glossy);
  mask lit = s.lit;
  if (!anyM(lit)) return;
  real c = minR(s.cosine, R(1.0));
  LightRows rows;
  if (kEffectFilteredShadows) rows = startRows(h, m, s.direction, c, diffuse);
  lit = passShadow(h, shadowRay(h, s.toLight), lit, rows);
  if (!anyM(lit)) return;
  if (!kEffectFilteredShadows) rows = startRows(h, m, s.direction, c, diffuse);
  real3 none = splat3(R(0.0));
  if (kEffectLightShapes) s.distance = selectR(isFar, R(0.0), s.distance);  // absorbs as the environment does: nothing
  real3 irradiance = lightIrradiance(h, light, s);
  if (anyM(diffuse)) {
    real3 radiance = lambertRadiance(m.albedo, irradiance * s.cosine, rows.diffuse.w);
    sum.diffuse = sum.diffuse + select3(andM(lit, diffuse), radiance, none);
  }
  real3 highlight = irradiance * s.lobe;
  if (kEffectFilteredShadows) highlight = highlight * rows.highlight.w;
  sum.highlight = sum.highlight + select3(lit, highlight, none);
}

// reflected: direction of the mirror ray, for the highlight.
FN DirectLight directLight(IN(Hit) h, IN(Material) m, real3 reflected) {
  DirectLight sum = noDirectLight();
  mask diffuse = lessR(R(0.0), maxR(m.albedo.x, maxR(m.albedo.y, m.albedo.z)));
  if (kEffectPointLights) {
    mask glossy = andM(lessR(R(0.0), m.highlightStrength), lessR(R(0.5), h.depth));
    if (anyM(orM(diffuse, glossy)))
      for (int i = 0; i < camera.lightCount; ++i) {
        PointLight light = lights[i];
        mask isFar = lessR(R(1.0), R(0.0));
        if (kEffectLightShapes) {
          LightShape shape = lightShape(i);
          isFar = lessR(R(0.0), shape.reach);
          light = shapedLight(light, shape, isFar, h.position);
        }
        addPointLight(sum, h, m, light, isFar, reflected, diffuse, glossy);
      }
  }
#if MALUS_EFFECT_AREA_LIGHTS
  if (camera.areaLightCount > 0) {
    if (anyM(diffuse)) addAreaLights(sum, h, m, diffuse);
  }
#endif
#if MALUS_EFFECT_ENVIRONMENT_LIGHT
  if (camera.environmentLight != 0u) {
    if (anyM(diffuse)) addEnvironmentLight(sum, h, m, diffuse);
  }
#endif
  if (kEffectAmbient) {
    if (anyM(andM(diffuse, lessR(R(0.0), camera.ambientIrradiance))))
      sum.diffuse = sum.diffuse + lambertRadiance(m.albedo, environmentIrradiance(h.normal) * camera.ambientIrradiance,
                                                  m.hemisphereTransmittance);
  }
  sum.diffuse = sum.diffuse * m.basicScale;
#if MALUS_EFFECT_MESH_TEXTURES
  // The layer below an interface may emit; thin glass has its transmittance there instead.
  sum.diffuse = sum.diffuse + m.radiance;
#endif
  sum.highlight = sum.highlight * m.basicScale;
  return sum;
}
