#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/glass.h"

void main() {
  Hit h = loadHit();
  result = shadeGlass(h, materialAt(h));
}
