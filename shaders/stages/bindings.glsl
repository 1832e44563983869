// Declares every descriptor of shaders/gpu/bindings.def that the variant needs.
#define MALUS_ACCELERATION_STRUCTURE(number, name) \
  layout(set = 0, binding = number) uniform accelerationStructureEXT name;
#define MALUS_PIXEL_BUFFER(number, name, element) \
  layout(set = 0, binding = number, scalar) writeonly buffer name##Block { element name[]; };
#define MALUS_SCENE_BUFFER(number, name, element, usage) \
  layout(set = 0, binding = number, scalar) readonly buffer name##Block { element name[]; };
#define MALUS_HOST_BUFFER(number, name, type, access) \
  layout(set = 0, binding = number, scalar) access buffer name##Block { type name; };
#include "shaders/gpu/bindings.def"

void countRay() {
#ifdef MALUS_COUNT_RAYS
  atomicAdd(rayCount, 1u);
#endif
}
