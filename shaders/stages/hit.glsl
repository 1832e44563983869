// Common to the closest-hit stages: the hit, from the instance's geometry.
#include "shaders/stages/bindings.glsl"
#include "shaders/stages/trace.glsl"
#include "shaders/surfaces/hit.h"
#include "shaders/stages/faults.glsl"
#include "shaders/stages/geometry.glsl"
#include "shaders/surfaces/check.h"
#include "shaders/surfaces/check_sent.h"
#include "shaders/surfaces/textures.h"
#include "shaders/surfaces/medium.h"
#include "shaders/surfaces/interface.h"
#include "shaders/surfaces/direct_light.h"
#include "shaders/surfaces/refraction.h"
#include "shaders/surfaces/polarizing_element_terms.h"
#include "shaders/surfaces/facet.h"
#include "shaders/surfaces/send.h"

layout(location = 0) rayPayloadInEXT Payload result;
hitAttributeEXT vec2 barycentric;

Hit loadHit() {
  return makeHitFromMesh(gl_GeometryIndexEXT, gl_PrimitiveID, barycentric, gl_WorldRayOriginEXT, gl_WorldRayDirectionEXT,
               payloadDepth(result));
}
