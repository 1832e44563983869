#include "shaders/stages/hit.glsl"

void main() {
  Hit h = loadHit();
  result = shadePolarizingElement(h, materialAt(h));
}
