// The effects of a build of a method, which its generated file defines as macros before.
#pragma once

#include "shaders/effects.h"

namespace malus::embree {

// Effects compiled into this translation unit.
static constexpr std::uint32_t kTileEffects = 0
#define MALUS_SHADER_ROW(id, macro, build, name, alias, description) \
  | (MALUS_EFFECT_##macro * shaders::effectBit(shaders::Effect::k##id))
#include "shaders/effects.def"
    ;

}  // namespace malus::embree
