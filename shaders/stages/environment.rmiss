// A ray that leaves the scene.
#include "shaders/stages/bindings.glsl"
#include "shaders/surfaces/hit.h"
#include "shaders/stages/faults.glsl"
#include "shaders/surfaces/check.h"
#include "shaders/surfaces/check_sent.h"
#include "shaders/surfaces/environment.h"
#include "shaders/surfaces/miss.h"

layout(location = 0) rayPayloadInEXT Payload result;

void main() { result = shadeEnvironment(gl_WorldRayDirectionEXT, payloadDepth(result)); }
