// Compiled shaders in the user's cache folder ($XDG_CACHE_HOME or ~/.cache, then malus/spirv), by a hash of
// everything that goes into them. A cache that cannot be read or written is as good as none.
#pragma once

#include <cstdint>
#include <vector>

#include "render/vulkan/variant.h"

namespace malus::vulkan {

std::vector<std::uint32_t> cachedSpirv(const Variant& variant, const StageSource& source);

}  // namespace malus::vulkan
