#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/glass.h"

void main() { result = shadeGlass(loadHit(), hitMaterial()); }
