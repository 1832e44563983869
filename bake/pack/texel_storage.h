// Storage of the texels of an environment map in a pack (section ENVR).
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace malus::pack {

// A component is a half times scale, a power of two, or a float.
struct TexelStorage {
  bool isFloat = false;
  double scale = 1;  // of halves
  bool isPlain() const { return !isFloat && scale == 1; }
  friend bool operator==(const TexelStorage&, const TexelStorage&) = default;
};

// Largest relative error of a stored texel. A half that is not subnormal errs by at most 2^-11 = 4.9e-4.
inline constexpr double kTexelError = 5e-4;

// Returns plain halves if no component errs by more than kTexelError, else halves with a scale that makes the largest
// component fit if that suffices, else floats. texels: finite, 0 or more.
TexelStorage chooseTexelStorage(const std::vector<glm::vec3>& texels);

// Rounds texels to what a pack stores.
void roundTexels(const TexelStorage& storage, std::vector<glm::vec3>& texels);

}  // namespace malus::pack
