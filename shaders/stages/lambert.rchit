#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/lambert.h"

void main() {
  Hit h = loadHit();
  result = shadeLambert(h, materialAt(h));
}
