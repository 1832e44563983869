// A ray that leaves the scene.
#include "shaders/stages/bindings.glsl"
#include "shaders/surfaces/miss.h"

layout(location = 0) rayPayloadInEXT Payload result;

void main() { result = shadeMiss(gl_WorldRayDirectionEXT); }
