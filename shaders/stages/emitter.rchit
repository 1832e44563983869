#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/emitter.h"

void main() { result = shadeEmitter(loadHit(), hitMaterial()); }
