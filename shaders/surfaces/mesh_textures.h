// Textures by the texture coordinates of meshes: material, roughness and normal at a hit.

#if MALUS_EFFECT_MESH_TEXTURES
FN mask hasMap(word map) { return notM(equalW(map, 0u)); }

// A level of a texture, bilinear. row: of textures[].
FN real3 mapLevel(word row, IN(TextureMap) map, real u, real v) {
  mask clampedU = equalW(map.wrapU, kWrapClamp);
  mask clampedV = equalW(map.wrapV, kWrapClamp);
  mask mirroredU = equalW(map.wrapU, kWrapMirror);
  mask mirroredV = equalW(map.wrapV, kWrapMirror);
  real width;
  real height;
  textureSize(row, width, height);
  real x = wrapCoordinate(u, clampedU, mirroredU) * width - R(0.5);
  real y = wrapCoordinate(v, clampedV, mirroredV) * height - R(0.5);
  real column = floorR(x);
  real line = floorR(y);
  real left = wrapTexel(column, width, clampedU, mirroredU);
  real right = wrapTexel(column + R(1.0), width, clampedU, mirroredU);
  real top = wrapTexel(line, height, clampedV, mirroredV);
  real bottom = wrapTexel(line + R(1.0), height, clampedV, mirroredV);
  return bilinear(texel(row, left, top), texel(row, right, top), texel(row, left, bottom), texel(row, right, bottom),
                  x - column, y - line);
}

// Coordinates of a set, and 1.
FN real3 setCoordinates(IN(TextureMap) map, IN(TexturePoint) t) {
  mask second = equalW(map.set, 1u);
  return make3(selectR(second, t.u1, t.u0), selectR(second, t.v1, t.v0), R(1.0));
}

// A map at a hit: between the two levels of its pyramid that are nearest to the footprint (trilinear).
FN real3 mapAt(word index, IN(TextureHit) t) {
  TextureMap map = textureMap(index);
  mask second = equalW(map.set, 1u);
  real3 p = setCoordinates(map, t.at);
  real u = dot3(map.u, p);
  real v = dot3(map.v, p);
  real width;
  real height;
  textureSize(map.texture, width, height);
  real scale = absR(map.u.x * map.v.y - map.u.y * map.v.x) * width * height;
  real texels = selectR(second, t.footprint1, t.footprint0) * sqrtR(scale);
  real level = textureLevel(texels, realOfWord(map.levels));
  real fine = floorR(level);
  real share = level - fine;
  real3 value = mapLevel(textureRow(map.texture, fine), map, u, v);
  mask between = lessR(R(0.0), share);
  if (anyM(between)) {
    real3 coarse = mapLevel(textureRow(map.texture, selectR(between, fine + R(1.0), fine)), map, u, v);
    value = select3(between, value * (R(1.0) - share) + coarse * share, value);
  }
  return value;
}

// Reflectance and edge tint in place of an index.
FN void setConductor(INOUT(Material) m, mask mapped, real3 reflectance, real tint) {
  real3 r = make3(minR(maxR(reflectance.x, kLeastReflectance), kMostReflectance),
                  minR(maxR(reflectance.y, kLeastReflectance), kMostReflectance),
                  minR(maxR(reflectance.z, kLeastReflectance), kMostReflectance));
  ConductorIndex red = conductorIndex(r.x, tint);
  ConductorIndex green = conductorIndex(r.y, tint);
  ConductorIndex blue = conductorIndex(r.z, tint);
  m.eta = select3(mapped, make3(red.eta, green.eta, blue.eta), m.eta);
  m.k = select3(mapped, make3(red.k, green.k, blue.k), m.k);
}

// The material with the values of its maps at a hit.
FN void applyMeshMaps(INOUT(Material) m, IN(Hit) h) {
  MeshMaps maps = meshMaps(h.material);
  mask albedo = hasMap(maps.albedo);
  if (anyM(albedo)) m.albedo = select3(albedo, mapAt(maps.albedo, h.texture), m.albedo);
  mask eta = hasMap(maps.eta);
  if (anyM(eta)) m.eta = select3(eta, mapAt(maps.eta, h.texture), m.eta);
  mask k = hasMap(maps.k);
  if (anyM(k)) m.k = select3(k, mapAt(maps.k, h.texture), m.k);
  mask reflectance = hasMap(maps.reflectance);
  if (anyM(reflectance)) {
    real tint = R(1.0);
    mask metallic = hasMap(maps.metallic);
    if (anyM(metallic)) tint = selectR(metallic, mapAt(maps.metallic, h.texture).x, tint);
    setConductor(m, reflectance, mapAt(maps.reflectance, h.texture), tint);
  }
  mask index = orM(eta, reflectance);
  if (anyM(index)) {
    real residue = materialExtra(h.material).outsideResidue;
    m.contrast = select3(index, (m.eta - splat3(m.outsideEta)) - splat3(residue), m.contrast);
  }
  mask radiance = hasMap(maps.radiance);
  if (anyM(radiance)) {
    real3 emitted = mapAt(maps.radiance, h.texture) * m.basicScale;
    // The back of an emitter radiates what its front does, or nothing.
    mask back = andM(radiance, andM(equalW(m.kind, kEmitter), lessR(R(0.0), m.albedo.x + m.albedo.y + m.albedo.z)));
    m.radiance = select3(radiance, emitted, m.radiance);
    m.albedo = select3(back, emitted, m.albedo);
  }
  mask transmittance = hasMap(maps.transmittance);
  if (anyM(transmittance)) m.radiance = select3(transmittance, mapAt(maps.transmittance, h.texture), m.radiance);
}

// Whether a triangle is cut out at a point: its coverage, of level 0, is below the cutoff.
FN mask isCutOut(word material, IN(TexturePoint) t) {
  MeshMaps maps = meshMaps(material);
  TextureMap map = textureMap(maps.coverage);
  real3 p = setCoordinates(map, t);
  real coverage = mapLevel(map.texture, map, dot3(map.u, p), dot3(map.v, p)).x;
  return andM(hasMap(maps.coverage), lessR(coverage, maps.cutoff));
}

// A triangle that a ray meets, and where: corners relative to the mesh's origin, and what is interpolated from them.
struct TexturedTriangle {
  real3 p0;
  real3 p1;
  real3 p2;
  TexturePoint t0;
  TexturePoint t1;
  TexturePoint t2;
  real b1;
  real b2;
  real3 tangent;    // interpolated; 0: from the derivatives of the coordinates
  real handedness;  // of the tangent
  real curvature;   // on the outside
};

// The ray's cone at the hit, and the coordinates there. origin: of the mesh.
FN TextureHit textureHitAt(IN(Ray) ray, real3 origin, IN(TexturedTriangle) t, OUT(RayCone) cone) {
  real3 e1 = t.p1 - t.p0;
  real3 e2 = t.p2 - t.p0;
  real3 way = trianglePoint(t.p0, e1, e2, t.b1, t.b2) - (ray.origin - origin);
  cone = coneAfter(coneOfPath(ray.path, camera.coneWidth, camera.coneSpread), sqrtR(dot3(way, way)));
  return textureHitOfTriangle(ray.d, e1, e2, t.b1, t.b2, cone.width, t.t0, t.t1, t.t2);
}

// The interpolated normal, or that of the material's normal map. interpolated: 0 for a flat mesh.
FN real3 normalAt(word material, IN(TextureHit) at, IN(TexturedTriangle) t, real3 interpolated) {
#if MALUS_EFFECT_NORMAL_MAPS
  MeshMaps maps = meshMaps(material);
  mask mapped = hasMap(maps.normal);
  if (!anyM(mapped)) return interpolated;
  real3 e1 = t.p1 - t.p0;
  real3 e2 = t.p2 - t.p0;
  real3 normal = select3(lessR(R(0.0), dot3(interpolated, interpolated)), interpolated, cross3(e1, e2));
  real lengthSq = dot3(normal, normal);
  mapped = andM(mapped, lessR(kNegligible, lengthSq));
  normal = normal * (R(1.0) / sqrtR(selectR(mapped, lengthSq, R(1.0))));
  mask second = equalW(textureMap(maps.normal).set, 1u);
  real u0 = selectR(second, t.t0.u1, t.t0.u0);
  real v0 = selectR(second, t.t0.v1, t.t0.v0);
  TriangleTangent derived =
      triangleTangent(e1, e2, selectR(second, t.t1.u1, t.t1.u0) - u0, selectR(second, t.t1.v1, t.t1.v0) - v0,
                      selectR(second, t.t2.u1, t.t2.u0) - u0, selectR(second, t.t2.v1, t.t2.v0) - v0);
  mask given = lessR(R(0.0), dot3(t.tangent, t.tangent));
  real3 tangent = select3(given, t.tangent, derived.tangent);
  real handedness = selectR(given, signNotZero(t.handedness), R(0.0) - signNotZero(derived.determinant));
  real3 n = mapAt(maps.normal, at) * R(2.0) - splat3(R(1.0));
  real3 result = mappedNormal(normal, tangent, handedness, n.x * maps.normalScale, n.y * maps.normalScale, n.z);
  mapped = andM(mapped, lessR(R(1e-12), dot3(result, result)));
  return select3(mapped, result, interpolated);
#else
  return interpolated;
#endif
}

// Sets what a hit has of textures.
FN void setTextureHit(INOUT(Hit) h, IN(TextureHit) at, IN(TexturedTriangle) t, IN(RayCone) cone) {
  h.texture = at;
  h.path = pathWithCone(h.path, cone);
  h.curvature = selectR(h.outside, t.curvature, R(0.0) - t.curvature);
  if (!kEffectRoughness) return;
  word map = meshMaps(h.material).roughness;
  mask rough = hasMap(map);
  if (anyM(rough)) h.roughness = selectR(rough, mapAt(map, at).x, h.roughness);
}
#endif
