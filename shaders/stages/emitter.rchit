#include "shaders/stages/hit.glsl"

void main() {
  Hit h = loadHit();
  result = shadeEmitter(h, materialAt(h));
}
