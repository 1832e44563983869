// Rays, and the point where a ray meets a surface.

// A ray to trace.
struct Ray {
  real3 origin;
  real3 d;     // unit direction
  real depth;  // specular interactions left
#if MALUS_EFFECT_ABSORPTION
  real originDistance;  // along the ray, from the point where it begins to its origin, which is off the face
#endif
#if MALUS_PATH_WORD
  word path;  // shaders/optics/path_word.h
#endif
};

struct Hit {
  real3 d;         // unit direction of the ray, away from the camera
  real3 position;  // of the hit
  real3 start;     // from where further rays leave: the position, moved off the triangle's edges
  real3 error;     // bound on the position's rounding error
  real3 face;      // unit normal of the face, against the ray
  real3 normal;    // unit normal to shade with, against the ray
  real c;          // cosine of the angle of incidence, in [0, 1]
  mask outside;    // the ray hits the side that the mesh's normals point to
  real depth;      // specular interactions left
  word material;   // index of the surface's material
  real travelled;  // distance from the point where the ray began; 0 without absorption
#if MALUS_EFFECT_ABSORPTION
  real rounding;  // height of the hit over `position`, which is rounded, along face
#endif
#if MALUS_PATH_WORD
  word path;  // of the ray
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  TextureHit texture;  // set after makeHit, as are these
  real roughness;      // from a texture; negative: the material's
  real curvature;      // of the surface on the side of the ray, 1/m, positive where it bulges toward the ray
#endif
};

CONST_REAL(kUnitRoundoff, 5.9604644775390625e-8);  // 2^-24, of float

// A triangle of more times the ray's length moves the hit onto the ray: barycentric coordinates then err by more than
// 1e-5 of the ray's length.
CONST_REAL(kLargeTriangle, 64.0);

// Absorption: the least cosine of a ray and a face by which distances are divided.
CONST_REAL(kGrazing, 0.0625);

FN Ray makeRay(real3 origin, real3 d, real depth, real distance) {
  Ray r;
  r.origin = origin;
  r.d = d;
  r.depth = depth;
#if MALUS_EFFECT_ABSORPTION
  r.originDistance = distance;
#endif
#if MALUS_PATH_WORD
  r.path = 0u;  // set by the caller
#endif
  return r;
}

// Hit of a ray. p0, p1, p2: corners of the triangle relative to the mesh's origin, counter-clockwise seen from outside;
// b1, b2: barycentric coordinates of p1 and p2; interpolated: normal interpolated from the vertices, or 0 for a flat
// mesh; placedError: of placed_triangle.h.
#if MALUS_EFFECT_INSTANCES
FN Hit makePlacedHit(IN(Ray) ray, real3 p0, real3 p1, real3 p2, real b1, real b2, real3 origin, real3 interpolated,
                     word material, real3 placedError)
#else
FN Hit makeHit(IN(Ray) ray, real3 p0, real3 p1, real3 p2, real b1, real b2, real3 origin, real3 interpolated,
               word material)
#endif
{
  real3 d = ray.d;
  real b0 = R(1.0) - b1 - b2;
  real3 e1 = p1 - p0;
  real3 e2 = p2 - p0;
  real3 normal = cross3(e1, e2);
  real areaSq = dot3(normal, normal);
  // A triangle without area has no normal: it is shaded as if it faced the ray.
  real3 face = select3(lessR(kNegligible, areaSq), normal * (R(1.0) / sqrtR(maxR(areaSq, kNegligible))), d * R(-1.0));
  Hit h;
  h.d = d;
  real3 local = trianglePoint(p0, e1, e2, b1, b2);
  real longest = maxR(largestPart(e1), maxR(largestPart(e2), largestPart(p2 - p1))) * R(1.7320508);
  real3 localFrom = ray.origin - origin;
  real3 way = local - localFrom;
  mask large = lessR(dot3(way, way) * (kLargeTriangle * kLargeTriangle), longest * longest);
  if (anyM(large)) local = select3(large, pointOnRay(local, localFrom, d, face, longest), local);
  h.position = local + origin;
  h.error = hitPointError(p0, e1, e2, b1, b2, kUnitRoundoff) + originError(origin, kUnitRoundoff) +
            splat3(intersectionError(p0, p1, p2, local, kUnitRoundoff));
#if MALUS_EFFECT_INSTANCES
  h.error = h.error + placedError;
#endif
  // Move the start off an edge that may be nearer than the margin, judged by the smallest possible height.
  real margin = R(4.0) * largestPart(h.error);
  h.start = h.position;
  mask nearEdge = lessR(minR(b0, minR(b1, b2)) * sqrtR(areaSq), margin * longest);
  if (anyM(nearEdge))
    h.start = select3(nearEdge, insideTriangle(local, p0, p1, p2, b0, b1, b2, normal, margin) + origin, h.start);
  h.outside = lessR(dot3(d, face), R(0.0));
  mask flatMesh = equalR(dot3(interpolated, interpolated), R(0.0));
  h.normal = shadingNormal(d, face, select3(flatMesh, face, interpolated));
  h.face = face * selectR(h.outside, R(1.0), R(-1.0));
  h.c = clampUnit(R(0.0) - dot3(d, h.normal));
  h.depth = ray.depth;
  h.material = material;
  h.travelled = R(0.0);
#if MALUS_EFFECT_ABSORPTION
  h.rounding = R(0.0);
  if (kEffectAbsorption) {
    // Close to a large triangle the distance is that of its plane, which the rounding of a point along the plane does
    // not change.
    real3 traced = local - localFrom;
    real slope = dot3(d, h.face);
    mask byPlane = andM(large, lessR(kGrazing, absR(slope)));
    real distance =
        selectR(byPlane, dot3(traced, h.face) / selectR(byPlane, slope, R(1.0)), sqrtR(dot3(traced, traced)));
    h.travelled = distance + ray.originDistance;
    PRECISE real3 rounded = h.position - origin;
    PRECISE real3 rest = local - rounded;
    h.rounding = dot3(rest, h.face);
  }
#endif
#if MALUS_PATH_WORD
  h.path = ray.path;
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  h.texture = noTextureHit();
  h.roughness = R(-1.0);
  h.curvature = R(0.0);
#endif
  return h;
}

#if MALUS_EFFECT_INSTANCES
FN Hit makeHit(IN(Ray) ray, real3 p0, real3 p1, real3 p2, real b1, real b2, real3 origin, real3 interpolated,
               word material) {
  return makePlacedHit(ray, p0, p1, p2, b1, b2, origin, interpolated, material, splat3(R(0.0)));
}
#endif

// In place of a hit where a ray leaves the scene, for the report of an unphysical value.
FN Hit environmentHit(real3 d, real depth) {
  real3 none = splat3(R(0.0));
  Hit h;
  h.d = d;
  h.position = none;
  h.start = none;
  h.error = none;
  h.face = none;
  h.normal = none;
  h.c = R(0.0);
  h.outside = true;
  h.depth = depth;
  h.material = kEnvironment;
  h.travelled = R(0.0);
#if MALUS_EFFECT_ABSORPTION
  h.rounding = R(0.0);
#endif
#if MALUS_PATH_WORD
  h.path = 0u;
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  h.texture = noTextureHit();
  h.roughness = R(-1.0);
  h.curvature = R(0.0);
#endif
  return h;
}

// Origins of rays that leave on the side of the camera, and on the other side.
FN real3 originAbove(IN(Hit) h) { return rayOrigin(h.start, h.error, h.face, kUnitRoundoff); }
FN real3 originBelow(IN(Hit) h) { return rayOrigin(h.start, h.error, h.face * R(-1.0), kUnitRoundoff); }

// Rays that leave the hit in direction d on the side of the camera, and on the other side. The medium begins at the
// hit, whose distance from the ray's origin is measured along the ray between planes parallel to the face: exact in
// thin panes, where it matters. It is bounded for grazing rays, which may end on a face of another direction.
FN Ray rayFrom(IN(Hit) h, real3 origin, real3 d, real depth) {
  real distance = R(0.0);
#if MALUS_EFFECT_ABSORPTION
  if (kEffectAbsorption)
    distance = absR(dot3(origin - h.position, h.face) - h.rounding) / maxR(absR(dot3(d, h.face)), kGrazing);
#endif
  return makeRay(origin, d, depth, distance);
}
FN Ray rayAbove(IN(Hit) h, real3 d, real depth) {
  Ray ray = rayFrom(h, originAbove(h), d, depth);
#if MALUS_PATH_WORD
  ray.path = reflectedPath(h.path);
#if MALUS_EFFECT_MESH_TEXTURES
  if (kEffectMeshTextures) ray.path = pathWithCone(ray.path, reflectedCone(coneOfBits(h.path), h.curvature, h.c));
#endif
#endif
  return ray;
}
FN Ray rayBelow(IN(Hit) h, real3 d, real depth) {
  Ray ray = rayFrom(h, originBelow(h), d, depth);
#if MALUS_PATH_WORD
  ray.path = transmittedPath(h.path);
#endif
  return ray;
}
