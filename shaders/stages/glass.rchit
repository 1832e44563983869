#include "shaders/stages/hit.glsl"

void main() {
  Hit h = loadHit();
  result = shadeGlass(h, materialAt(h));
}
