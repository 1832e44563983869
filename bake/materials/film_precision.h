// Precision of a thin film in the single-precision renderers: the phase of a round trip is rounded to a fraction of the
// number of waves, so that a thick film, or one of a high index, differs from double precision.
#pragma once

#include <optional>

#include "bake/pack/scene.h"

namespace malus::bake {

// Largest difference of a power reflectance from double precision that is not reported.
inline constexpr double kFilmPrecision = 1e-4;

struct FilmPrecision {
  double difference = 0;  // largest of R_s and R_p from double precision, over angles, colours and both sides
  double waves = 0;       // optical thickness of the film in wavelengths in vacuum, the largest of the colours
  double limitWaves = 0;  // optical thickness up to which the difference stays within kFilmPrecision
};

// The precision of a material's film if it is worse than kFilmPrecision; none for other materials.
std::optional<FilmPrecision> insufficientFilmPrecision(const pack::Material& material,
                                                       const glm::dvec3& wavelengthsNm = pack::kDefaultWavelengthsNm);

}  // namespace malus::bake
