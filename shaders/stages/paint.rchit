#include "shaders/stages/hit.glsl"

void main() {
  Hit h = loadHit();
  result = shadePaint(h, materialAt(h));
}
