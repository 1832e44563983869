#include "shaders/stages/hit.glsl"

void main() {
  Hit h = loadHit();
  result = shadeLambert(h, materialAt(h));
}
