// Light of one point light at a hit: first its geometry, then, where no surface blocks it, its contribution.

struct LightSample {
  real3 toLight;    // from the hit
  real3 direction;  // unit vector toward the light
  real distance;    // in metres
  real distanceSq;
  real cosine;  // of the angle between direction and the shading normal
  real lobe;    // highlight in the reflected direction, in 1/sr times the material's strength
  mask lit;     // the light is in front of the face and shows in the diffuse light or the highlight
};

// The point light that a spot light is to a point, or that stands for a light at infinity: at the distance `reach` of
// the shape, with the intensity that gives the same irradiance there. Source of the cone: KHR_lights_punctual, "Inner
// and Outer Cone Angles".
FN PointLight shapedLight(IN(PointLight) light, LightShape shape, mask isFar, real3 point) {
  real3 fromLight = point - light.position;
  real c = dot3(shape.axis, fromLight) * (R(1.0) / divisor(sqrtR(dot3(fromLight, fromLight))));
  real cone = minR(maxR(c * shape.coneScale + shape.coneOffset, R(0.0)), R(1.0));
  PointLight result;
  result.position = select3(isFar, point - shape.axis * shape.reach, light.position);
  result.intensity = light.intensity * selectR(isFar, shape.reach * shape.reach, cone * cone);
  return result;
}

// reflected: direction of the mirror ray. diffuse, glossy: whether the material scatters so.
FN LightSample sampleLight(IN(Hit) h, IN(Material) m, IN(PointLight) light, real3 reflected, mask diffuse,
                           mask glossy) {
  LightSample s;
  s.toLight = light.position - h.position;
  s.distanceSq = dot3(s.toLight, s.toLight);
  s.distance = sqrtR(s.distanceSq);
  s.direction = s.toLight * (R(1.0) / divisor(s.distance));
  s.cosine = dot3(h.normal, s.direction);
  s.lobe = R(0.0);
  s.lit = notM(orM(lessEqualR(s.cosine, R(0.0)), lessEqualR(dot3(h.face, s.direction), R(0.0))));
  if (kEffectHighlights) {
    mask shows = andM(s.lit, glossy);
    if (anyM(shows))
      s.lobe = selectR(shows, m.highlightStrength * phongLobe(reflected, s.direction, m.highlightExponent), R(0.0));
  }
  s.lit = andM(s.lit, notM(andM(notM(diffuse), lessEqualR(s.lobe, R(0.0)))));
  return s;
}

struct ShadowRay {
  real3 origin;
  real3 way;  // from the origin to its end
};

// Ray that other surfaces block if they block the light. It starts outside the hit's error box, as every ray does, and
// ends at the light; closer to the face than twice the box, where it could meet the face itself, it is parallel to the
// way from the hit to the light.
FN ShadowRay shadowRay(IN(Hit) h, real3 toLight) {
  ShadowRay r;
  r.origin = originAbove(h);
  real3 offset = r.origin - h.position;
  real3 straight = toLight - offset;
  mask near = lessEqualR(dot3(h.face, straight - offset), R(0.0));
  r.way = select3(near, toLight, straight);
  return r;
}

// Irradiance on a surface that faces the light, in W/m^2.
FN real3 lightIrradiance(IN(Hit) h, IN(PointLight) light, LightSample s) {
  real3 irradiance = light.intensity * (R(1.0) / divisor(s.distanceSq));
  if (kEffectAbsorption) irradiance = irradiance * transmittanceOver(mediumAbsorption(h), s.distance);
  return irradiance;
}
