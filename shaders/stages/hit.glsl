// Common to the closest-hit stages: the hit, from the instance's geometry.
#include "shaders/stages/bindings.glsl"
#include "shaders/stages/trace.glsl"
#include "shaders/surfaces/hit.h"
#include "shaders/stages/faults.glsl"
#include "shaders/surfaces/check.h"
#include "shaders/surfaces/direct_light.h"

layout(location = 0) rayPayloadInEXT Payload result;
hitAttributeEXT vec2 barycentric;

Material hitMaterial() { return materials[meshes[gl_GeometryIndexEXT].material]; }

Hit loadHit() {
  Mesh mesh = meshes[gl_GeometryIndexEXT];
  uvec3 corner = triangles[mesh.firstTriangle + gl_PrimitiveID] + mesh.firstVertex;
  float b0 = 1.0 - barycentric.x - barycentric.y;
  vec3 interpolated = vec3(0.0);
  if (mesh.hasNormals != 0u)
    interpolated = normals[corner.x] * b0 + normals[corner.y] * barycentric.x + normals[corner.z] * barycentric.y;
  return makeHit(gl_WorldRayDirectionEXT, positions[corner.x], positions[corner.y], positions[corner.z], barycentric.x,
                 barycentric.y, interpolated, payloadDepth(result), mesh.material);
}
