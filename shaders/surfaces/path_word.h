// Whether rays carry a path word (shaders/optics/path_word.h): 1 in variants with an effect that needs it, else 0, so
// that the rays, hits and payloads of the others do not change. On the way down a payload has the depth in its first
// word, the distance of absorption in its second and the path word in its third.
#ifndef MALUS_PATH_WORD
#define MALUS_PATH_WORD (MALUS_EFFECT_MESH_TEXTURES || MALUS_EFFECT_AREA_LIGHTS || MALUS_EFFECT_ENVIRONMENT_LIGHT)
#endif
