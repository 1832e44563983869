#include "bake/pack/texel_storage.h"

#include <algorithm>
#include <cmath>

#include "bake/pack/half.h"

namespace malus::pack {

namespace {

float stored(float value, double scale) {
  return static_cast<float>(floatFromHalf(halfFromFloat(static_cast<float>(value / scale))) * scale);
}

bool suffices(const std::vector<glm::vec3>& texels, double scale) {
  return std::all_of(texels.begin(), texels.end(), [&](const glm::vec3& t) {
    for (int c = 0; c < 3; ++c)
      if (std::abs(double{stored(t[c], scale)} - t[c]) > kTexelError * t[c]) return false;
    return true;
  });
}

}  // namespace

TexelStorage chooseTexelStorage(const std::vector<glm::vec3>& texels) {
  if (suffices(texels, 1)) return {};
  float most = 0;
  for (const glm::vec3& t : texels) most = std::max({most, t.x, t.y, t.z});
  // The largest component becomes 2^14 to 2^15, below the largest half.
  const double scale = std::ldexp(1.0, std::ilogb(most) - 14);
  if (suffices(texels, scale)) return {false, scale};
  return {true, 1};
}

void roundTexels(const TexelStorage& storage, std::vector<glm::vec3>& texels) {
  if (storage.isFloat) return;
  for (glm::vec3& t : texels)
    for (int c = 0; c < 3; ++c) t[c] = stored(t[c], storage.scale);
}

}  // namespace malus::pack
