#include "bake/materials/dielectric_k.h"

#include <numbers>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::bake {

void convertDielectricK(const glm::dvec3& wavelengthsNm, pack::Material& m) {
  for (int c = 0; c < 3; ++c)
    if (m.k[c] > kMostDielectricK)
      throw Error("", "k is too large for that of a dielectric",
                  fmt::format("at most {}, or the type metal", kMostDielectricK),
                  fmt::format("{:g} at {:g} nm", m.k[c], wavelengthsNm[c]));
  if (pack::hasInside(m.kind)) m.absorption = 4e9 * std::numbers::pi * m.k / wavelengthsNm;
  m.k = glm::dvec3(0.0);
}

}  // namespace malus::bake
