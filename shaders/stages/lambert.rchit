#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/lambert.h"

void main() { result = shadeLambert(loadHit(), hitMaterial()); }
