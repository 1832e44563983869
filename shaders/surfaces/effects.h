// Effects compiled into this build, as constants kEffect<id>: the compiler removes a branch on one that is false. The
// macros come from the build (C++) or from the variant's preamble (GLSL). #if remains where a buffer does not exist.
#define MALUS_SHADER_ROW(id, macro, build, name, alias, description) CONST bool kEffect##id = MALUS_EFFECT_##macro != 0;
#include "shaders/effects.def"
