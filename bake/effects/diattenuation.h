// Largest diattenuation of an interface over a range of angles of incidence.
#pragma once

#include <vector>

#include "bake/effects/interface_patches.h"
#include "bake/pack/scene.h"

namespace malus::bake {

// Largest value of a function of a cosine over a range of cosines.
class RangeMaximum {
 public:
  RangeMaximum() = default;
  // cells[i]: the largest value over cosines from i/n to (i + 1)/n, n = cells.size().
  explicit RangeMaximum(std::vector<double> cells);
  double over(const CosineRange& range) const;  // 0 over an empty range

 private:
  std::vector<std::vector<double>> levels_;  // levels_[k][i]: over the 2^k cells from i on
};

// Of one material and colour.
struct Diattenuation {
  RangeMaximum interaction;  // reflection or refraction, on either side
  RangeMaximum leaving;      // diffuse light that leaves from below; 0 if there is none
};
Diattenuation diattenuation(const pack::Material& material, int colour);

}  // namespace malus::bake
