// Compiled shaders in the user's cache folder (cacheFolder("spirv")), by a hash of all inputs of the compilation. A
// cache that cannot be read or written is ignored.
#pragma once

#include <cstdint>
#include <vector>

#include "render/vulkan/variant.h"

namespace malus::vulkan {

std::vector<std::uint32_t> cachedSpirv(const Variant& variant, const StageSource& source);

}  // namespace malus::vulkan
