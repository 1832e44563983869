// Smallest and largest values of textures.
#pragma once

#include <vector>

#include "bake/pack/scene.h"

namespace malus::pack {

struct TexelRange {
  float low = 0, high = 0;
};
// One per texture; a texture has texels.
std::vector<TexelRange> findTexelRanges(const std::vector<Texture>& textures);

}  // namespace malus::pack
