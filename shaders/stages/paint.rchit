#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/opaque.h"
#include "shaders/surfaces/paint.h"

void main() { result = shadePaint(loadHit(), hitMaterial()); }
