// Effects of this build, as constants kEffect<id>: the compiler removes a branch on one that is false. The macros come
// from the build (C++) or from the variant's preamble (GLSL). #if remains where a buffer does not exist. A build that
// contains every effect may define the constants by the effects that an image needs
// (render/embree/packets/tracer-inl.h).
#ifndef EFFECT_CONST
#define EFFECT_CONST CONST
#define EFFECT_IS_ON(id, compiled) (compiled != 0)
#endif
#define MALUS_SHADER_ROW(id, macro, build, name, alias, description) \
  EFFECT_CONST bool kEffect##id = EFFECT_IS_ON(id, MALUS_EFFECT_##macro);
#include "shaders/effects.def"
