// Shades a ray that meets no surface.
#include "shaders/stages/bindings.glsl"
#include "shaders/stages/launch_pixel.glsl"
#include "shaders/surfaces/recursive.h"
#include "shaders/stages/faults.glsl"

layout(location = 0) rayPayloadInEXT Payload result;

void main() { result = shadeEnvironment(gl_WorldRayDirectionEXT, payloadDepth(result)); }
