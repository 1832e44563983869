#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/opaque.h"
#include "shaders/surfaces/metal.h"

void main() {
  Hit h = loadHit();
  result = shadeMetal(h, materialAt(h));
}
