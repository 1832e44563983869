// The rays that shaders/surfaces/hooks.h declares, traced by the ray generation shader alone: by ray queries, or by a
// pipeline whose other shaders return a hit record.
#include "shaders/stages/geometry.glsl"

#ifdef MALUS_RAY_QUERIES

bool findHit(Ray ray, out Hit h) {
  countRay();
  rayQueryEXT query;
  rayQueryInitializeEXT(query, tlas, gl_RayFlagsOpaqueEXT, 0xffu, ray.origin, 0.0, ray.d, 1e30);
  while (rayQueryProceedEXT(query)) {
  }
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
  rayQueryInitializeEXT(query, tlas, gl_RayFlagsOpaqueEXT | gl_RayFlagsTerminateOnFirstHitEXT, 0xffu, origin, 0.0,
                        way, 1.0);
  while (rayQueryProceedEXT(query)) {
  }
  return rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT;
}

#else

#include "shaders/stages/hit_record.glsl"

layout(location = 0) rayPayloadEXT HitRecord hitRecord;

bool findHit(Ray ray, out Hit h) {
  countRay();
  traceRayEXT(tlas, gl_RayFlagsOpaqueEXT, 0xffu, 0u, 0u, 0u, ray.origin, 0.0, ray.d, 1e30, 0);
  if (hitRecord.mesh == kNoMesh) return false;
  h = makeHitFromMesh(hitRecord.mesh, 0u, hitRecord.triangle, hitRecord.barycentric, ray);
  return true;
}

bool visible(bool needed, vec3 origin, vec3 way) {
  countRay();
  hitRecord.mesh = 0u;
  traceRayEXT(tlas, gl_RayFlagsOpaqueEXT | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT,
              0xffu, 0u, 0u, 0u, origin, 0.0, way, 1.0, 0);
  return hitRecord.mesh == kNoMesh;
}

#endif
