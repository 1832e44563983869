// Lights that are extended, emitting surfaces and the environment: light on diffuse surfaces by samples of the solid
// angle with a shadow ray each. The samples of a hit are a stratified set, the same for every hit, rotated by its path
// word: u = (k + r)/N, and v = the radical inverse of k, plus r' modulo 1.

#if MALUS_PATH_WORD

// A sample of a light, as a hit sees it.
struct SampledLight {
  real3 toLight;  // from the hit to the end of the shadow ray
  real3 direction;
  real cosine;       // of the angle between direction and the shading normal
  real3 irradiance;  // at normal incidence, that the sample represents
  real3 field;       // normal of the plane whose s direction is the field of polarized light
  real degree;       // of its linear polarization
  mask lit;
};

struct SamplePoint {
  real u;
  real v;
};

// Sample k of a hit. purpose: of the rotation.
FN SamplePoint samplePoint(IN(Hit) h, word purpose, uint k) {
  real turnU;
  real turnV;
  pathRotation(h.path, purpose, turnU, turnV);
  SamplePoint p;
  p.u = (real(k) + turnU) * (R(1.0) / real(camera.lightSamples));
  p.v = wrapUnit(radicalInverse(k) + turnV);
  return p;
}

FN SampledLight towardLight(IN(Hit) h, real3 direction, real3 irradiance, mask diffuse) {
  SampledLight s;
  s.toLight = direction;
  s.direction = direction;
  s.cosine = dot3(h.normal, direction);
  s.irradiance = irradiance;
  s.field = direction;
  s.degree = R(0.0);
  s.lit = andM(diffuse, andM(lessR(R(0.0), s.cosine), lessR(R(0.0), dot3(h.face, direction))));
  return s;
}

FN void addSampledLight(INOUT(DirectLight) sum, IN(Hit) h, IN(Material) m, IN(SampledLight) s) {
  if (!anyM(s.lit)) return;
  real c = minR(s.cosine, R(1.0));
  LightRows rows;
  if (kEffectFilteredShadows) rows = startRows(h, m, s.direction, c, s.lit);
  mask lit = passShadow(h, shadowRay(h, s.toLight), s.lit, rows);
  if (!anyM(lit)) return;
  if (!kEffectFilteredShadows) rows = startRows(h, m, s.direction, c, s.lit);
  real3 entering = rows.diffuse.w;
  mask polarized = lessR(R(0.0), s.degree);
  if (anyM(polarized))
    entering = select3(polarized, polarizedTransmittance(rows.diffuse, s.direction, s.field, s.degree), entering);
  sum.diffuse =
      sum.diffuse + select3(lit, lambertRadiance(m.albedo, s.irradiance * s.cosine, entering), splat3(R(0.0)));
}

#if MALUS_EFFECT_AREA_LIGHTS

struct LightChoice {
  word light;
  real probability;  // 0: all lights are hidden
  real u;            // in [0, 1), what the choice leaves of the sample's u
};

// Follows the tree of lights from its root: at each node the sample goes to one of two groups, in proportion to their
// estimated irradiance.
FN LightChoice chooseLight(IN(Hit) h, real u) {
  LightChoice choice;
  choice.probability = R(1.0);
  choice.u = u;
  LightNode node = lightNode(0u);
  for (int level = 0; level < camera.lightLevels; ++level) {
    mask inner = lessR(R(0.5), node.isInner);
    if (!anyM(inner)) break;
    // In the lanes that are at a light, the two groups are those of the root.
    word first = wordOfReal(selectR(inner, realOfWord(node.index), R(1.0)));
    LightNode a = lightNode(first);
    LightNode b = lightNode(addW(first, 1u));
    real left = lightImportance(h.position, h.normal, a.centre, a.radius, a.axis, a.spread, a.power);
    real sum = left + lightImportance(h.position, h.normal, b.centre, b.radius, b.axis, b.spread, b.power);
    mask reaches = lessR(kNegligible, sum);
    real share = left / divisor(sum);
    mask goesLeft = lessR(choice.u, share);
    real part = selectR(goesLeft, share, R(1.0) - share);
    real rest = selectR(goesLeft, choice.u, choice.u - share) / divisor(part);
    choice.u = selectR(inner, minR(rest, R(0.99999994)), choice.u);
    choice.probability = selectR(inner, selectR(reaches, choice.probability * part, R(0.0)), choice.probability);
    node = SELECT(andM(inner, goesLeft), a, SELECT(inner, b, node));
  }
  choice.light = node.index;
  return choice;
}

FN AreaSample sampleAreaLight(IN(AreaLight) light, real3 corner, real u, real v) {
  real3 across = light.normal * light.parallelogram;
  mask rectangle = lessR(R(0.5), light.isRectangle);
  AreaSample s = sampleTriangleLight(corner, light.edgeU, light.edgeV, across, u, v);
  if (anyM(rectangle)) {
    AreaSample r = sampleRectangleLight(corner, light.edgeU, light.edgeV, across, u, v);
    s.toLight = select3(rectangle, r.toLight, s.toLight);
    s.measure = selectR(rectangle, r.measure, s.measure);
  }
  return s;
}

FN void addAreaLights(INOUT(DirectLight) sum, IN(Hit) h, IN(Material) m, mask diffuse) {
  for (uint k = 0u; k < camera.lightSamples; ++k) {
    SamplePoint point = samplePoint(h, 1u, k);
    LightChoice choice = chooseLight(h, point.u);
    AreaLight light = areaLight(choice.light);
    AreaSample a = sampleAreaLight(light, light.corner - h.position, choice.u, point.v);
    real distance = sqrtR(dot3(a.toLight, a.toLight));
    real3 direction = a.toLight * (R(1.0) / divisor(distance));
    mask front = lessR(dot3(direction, light.normal), R(0.0));
    real3 radiance = select3(front, light.radiance, light.backRadiance);
    real share = a.measure / divisor(choice.probability * real(camera.lightSamples));
    SampledLight s = towardLight(h, direction, radiance * share, diffuse);
    s.lit = andM(s.lit, andM(lessR(R(0.0), choice.probability), lessR(R(0.0), radiance.x + radiance.y + radiance.z)));
    if (kEffectAbsorption) s.irradiance = s.irradiance * transmittanceOver(mediumAbsorption(h), distance);
    if (kEffectPolarizedEmitters) {
      s.field = cross3(light.normal, light.axis);
      s.degree = light.degree;
    }
    // The ray ends before the light, by more than the rounding of the two.
    real offset = light.offset + largestPart(h.position) * R(9.5367431640625e-7);
    s.toLight = a.toLight + light.normal * selectR(front, offset, R(0.0) - offset);
    addSampledLight(sum, h, m, s);
  }
}
#endif

#if MALUS_EFFECT_ENVIRONMENT_LIGHT

// The interval of a cumulative distribution that contains u, from the entry `first` of the table on, whose entries are
// 0 to 1. u becomes the position within the interval.
FN void searchDistribution(real first, INOUT(real) u, OUT(real) index, OUT(real) mass) {
  real count = real(camera.environmentSize);
  index = R(0.0);
  for (uint step = camera.environmentStep; step > 0u; step = step / 2u) {
    real next = minR(index + real(step), count);
    index = selectR(lessEqualR(environmentDistribution(first + next), u), next, index);
  }
  real low = environmentDistribution(first + index);
  mass = environmentDistribution(first + index + R(1.0)) - low;
  u = clampUnit((u - low) / divisor(mass));
}

// Direction to the environment for a sample; share: the inverse of its density, in sr. A map is sampled by the product
// of luminance and solid angle of its texels, a constant by the cosine.
FN real3 environmentDirection(IN(Hit) h, SamplePoint point, OUT(real) share) {
  if (!kEffectEnvironmentMap || camera.environmentSize == 0) {
    real3 direction = cosineDirection(h.normal, point.u, point.v);
    share = kPi / maxR(dot3(h.normal, direction), R(1e-6));
    return direction;
  }
  real size = real(camera.environmentSize);
  real row;
  real rowMass;
  real column;
  real columnMass;
  searchDistribution(R(0.0), point.u, row, rowMass);
  searchDistribution((row + R(1.0)) * (size + R(1.0)), point.v, column, columnMass);
  real scale = R(1.0) / size;
  real3 direction = directionFromOctahedral((column + point.v) * scale, (row + point.u) * scale);
  share = octahedralSolidAngle(direction) * scale * scale / divisor(rowMass * columnMass);
  return direction;
}

FN void addEnvironmentLight(INOUT(DirectLight) sum, IN(Hit) h, IN(Material) m, mask diffuse) {
  for (uint k = 0u; k < camera.lightSamples; ++k) {
    real share;
    real3 direction = environmentDirection(h, samplePoint(h, 2u, k), share);
    real degree = R(0.0);
    real3 radiance;
    if (kEffectSky) {
      radiance = skyRadiance(direction, degree);
    } else {
      radiance = environmentRadiance(direction);
    }
    SampledLight s = towardLight(h, direction, radiance * (share / real(camera.lightSamples)), diffuse);
    s.toLight = direction * camera.lightReach;
    s.field = camera.sun;
    s.degree = degree;
    addSampledLight(sum, h, m, s);
  }
}
#endif

#endif
