#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/emitter.h"

void main() {
  Hit h = loadHit();
  result = shadeEmitter(h, materialAt(h));
}
