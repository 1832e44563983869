#include "shaders/stages/hit.glsl"
#include "shaders/surfaces/polarizing_element.h"

void main() {
  Hit h = loadHit();
  result = shadePolarizingElement(h, materialAt(h));
}
