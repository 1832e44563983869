// The rays that shaders/surfaces/hooks.h declares, traced by the ray generation shader alone: by ray queries, or by a
// pipeline whose other shaders return a hit record.
#include "shaders/stages/geometry.glsl"
#include "shaders/stages/cut_out.glsl"

#ifdef MALUS_RAY_QUERIES

// Follows a query past what is cut out.
#if MALUS_EFFECT_CUT_OUTS && MALUS_EFFECT_MESH_TEXTURES
#define MALUS_PROCEED(query)                                                              \
  while (rayQueryProceedEXT(query)) {                                                     \
    if (!isCutOutAt(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false),          \
                    rayQueryGetIntersectionGeometryIndexEXT(query, false),                \
                    rayQueryGetIntersectionPrimitiveIndexEXT(query, false),               \
                    rayQueryGetIntersectionBarycentricsEXT(query, false)))                \
      rayQueryConfirmIntersectionEXT(query);                                              \
  }
#else
#define MALUS_PROCEED(query)          \
  while (rayQueryProceedEXT(query)) { \
  }
#endif

bool findHit(Ray ray, out Hit h) {
  countRay();
  rayQueryEXT query;
  rayQueryInitializeEXT(query, tlas, kOpaqueFlag, 0xffu, ray.origin, 0.0, ray.d, 1e30);
  MALUS_PROCEED(query)
  if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return false;
  h = makeHitFromMesh(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true),
                      rayQueryGetIntersectionGeometryIndexEXT(query, true),
                      rayQueryGetIntersectionPrimitiveIndexEXT(query, true),
                      rayQueryGetIntersectionBarycentricsEXT(query, true), ray);
  return true;
}

bool visible(bool needed, vec3 origin, vec3 way) {
  countRay();
  rayQueryEXT query;
  rayQueryInitializeEXT(query, tlas, kOpaqueFlag | gl_RayFlagsTerminateOnFirstHitEXT, 0xffu, origin, 0.0,
                        way, 1.0);
  MALUS_PROCEED(query)
  return rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT;
}

#else

#include "shaders/stages/hit_record.glsl"

layout(location = 0) rayPayloadEXT HitRecord hitRecord;

bool findHit(Ray ray, out Hit h) {
  countRay();
  traceRayEXT(tlas, kOpaqueFlag, 0xffu, 0u, 0u, 0u, ray.origin, 0.0, ray.d, 1e30, 0);
  if (hitRecord.mesh == kNoMesh) return false;
  h = makeHitFromMesh(hitRecord.mesh, 0u, hitRecord.triangle, hitRecord.barycentric, ray);
  return true;
}

bool visible(bool needed, vec3 origin, vec3 way) {
  countRay();
  hitRecord.mesh = 0u;
  traceRayEXT(tlas, kOpaqueFlag | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT,
              0xffu, 0u, 0u, 0u, origin, 0.0, way, 1.0, 0);
  return hitRecord.mesh == kNoMesh;
}

#endif
