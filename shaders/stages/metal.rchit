#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/opaque.h"
#include "shaders/surfaces/metal.h"

void main() { result = shadeMetal(loadHit(), hitMaterial()); }
