#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/sheet.h"

void main() {
  Hit h = loadHit();
  result = shadeSheet(h, materialAt(h));
}
