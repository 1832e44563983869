#include "shaders/stages/hit.glsl"

void main() {
  Hit h = loadHit();
  result = shadeMetal(h, materialAt(h));
}
