// Closest hit of a ray that returns a hit record, on any kind of surface.
#include "shaders/stages/hit_record.glsl"

layout(location = 0) rayPayloadInEXT HitRecord hitRecord;
hitAttributeEXT vec2 barycentric;

void main() {
  hitRecord.mesh = gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT;
  hitRecord.triangle = gl_PrimitiveID;
  hitRecord.barycentric = barycentric;
}
