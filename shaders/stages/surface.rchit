// Closest hit of one kind of surface: MALUS_SHADE is its function (render/vulkan/variant.cpp).
#include "shaders/stages/hit.glsl"

void main() {
  Hit h = loadHit();
  result = MALUS_SHADE(h, materialAt(h));
}
