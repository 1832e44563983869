#include "bake/pack/half.h"

#include <algorithm>

#include <glm/gtc/packing.hpp>

namespace malus::pack {

std::uint16_t halfFromFloat(float value) { return glm::packHalf1x16(std::clamp(value, -65504.0f, 65504.0f)); }

float floatFromHalf(std::uint16_t bits) { return glm::unpackHalf1x16(bits); }

}  // namespace malus::pack
