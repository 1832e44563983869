// Removal of dead code from SPIR-V, before a driver compiles it.
#pragma once

#include <cstdint>
#include <vector>

namespace malus::vulkan {

// Removes branches on constant conditions, the blocks and the functions that no entry point then reaches, and the names
// and decorations of what is removed. glslang keeps the code of an effect that is off (`if (kEffectX)` with a false
// constant), and a driver's time grows with it. module: one valid SPIR-V module, as glslang writes it.
std::vector<std::uint32_t> withoutDeadCode(const std::vector<std::uint32_t>& module);

}  // namespace malus::vulkan
