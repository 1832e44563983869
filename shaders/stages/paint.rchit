#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/opaque.h"
#include "shaders/surfaces/paint.h"

void main() {
  Hit h = loadHit();
  result = shadePaint(h, materialAt(h));
}
