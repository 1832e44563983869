// Common to the closest-hit stages: the hit, and the payload that the stage returns.
#include "shaders/stages/bindings.glsl"
#include "shaders/stages/launch_pixel.glsl"
#include "shaders/surfaces/recursive.h"
#include "shaders/stages/trace.glsl"
#include "shaders/stages/faults.glsl"
#include "shaders/stages/geometry.glsl"

layout(location = 0) rayPayloadInEXT Payload result;
hitAttributeEXT vec2 barycentric;

Hit loadHit() {
  float distance = 0.0;
  if (kEffectAbsorption) distance = payloadOriginDistance(result);
  Ray ray = makeRay(gl_WorldRayOriginEXT, gl_WorldRayDirectionEXT, payloadDepth(result), distance);
#if MALUS_PATH_WORD
  ray.path = payloadPath(result);
#endif
  return makeHitFromMesh(gl_InstanceCustomIndexEXT, gl_GeometryIndexEXT, gl_PrimitiveID, barycentric, ray);
}
