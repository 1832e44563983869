// The rays that shaders/surfaces/hooks.h declares, by recursive traces. Miss shader 0 is the environment's, 1 the
// shadow's.
#include "shaders/stages/cut_out.glsl"

layout(location = 1) rayPayloadEXT Payload childPayload;
layout(location = 2) rayPayloadEXT uint shadowPayload;

Payload traceRay(Ray ray) {
  countRay();
  payloadSetDepth(childPayload, ray.depth);
#if MALUS_EFFECT_ABSORPTION
  payloadSetOriginDistance(childPayload, ray.originDistance);
#endif
#if MALUS_PATH_WORD
  payloadSetPath(childPayload, ray.path);
#endif
  traceRayEXT(tlas, kOpaqueFlag, 0xffu, 0u, 1u, 0u, ray.origin, 0.0, ray.d, 1e30, 1);
  return childPayload;
}

bool visible(bool needed, vec3 origin, vec3 way) {
  countRay();
  shadowPayload = 1u;
  traceRayEXT(tlas, kOpaqueFlag | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT,
              0xffu, 0u, 1u, 1u, origin, 0.0, way, 1.0, 2);
  return shadowPayload == 0u;
}
