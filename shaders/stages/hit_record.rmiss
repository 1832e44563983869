// A ray that returns a hit record and meets no surface.
#include "shaders/stages/hit_record.glsl"

layout(location = 0) rayPayloadInEXT HitRecord hitRecord;

void main() { hitRecord.mesh = kNoMesh; }
