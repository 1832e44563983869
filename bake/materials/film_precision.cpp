#include "bake/materials/film_precision.h"

#include <algorithm>
#include <cmath>

#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

// Cosines at which a film is compared: squares of evenly spaced numbers, with both ends. A film of a high index changes
// fastest near grazing incidence.
constexpr int kCosines = 512;

struct Side {
  double n1, n3;
};

double largestDifference(const pack::Material& m, int colour, const Side& side, double roundTripPhase) {
  const double nf = m.coating.eta[colour], k3 = pack::isConductor(m.kind) ? m.k[colour] : 0;
  const f64::FilmLayers exact{side.n1, nf, side.n3, k3, nf - side.n1, side.n3 - side.n1, nf - side.n3, roundTripPhase};
  const auto rounded = [](double value) { return static_cast<float>(value); };
  const f32::FilmLayers single{rounded(exact.n1),           rounded(exact.nf),       rounded(exact.n3),
                               rounded(exact.k3),           rounded(exact.filmStep), rounded(exact.baseStep),
                               rounded(exact.filmOverBase), rounded(roundTripPhase)};
  double largest = 0;
  for (int i = 0; i <= kCosines; ++i) {
    const float root = static_cast<float>(i) / kCosines, c = root * root;
    const f64::Reflectance a = f64::filmResponse(static_cast<double>(c), exact).reflected;
    const f32::Reflectance b = f32::filmResponse(c, single).reflected;
    largest =
        std::max({largest, std::abs(a.rs - static_cast<double>(b.rs)), std::abs(a.rp - static_cast<double>(b.rp))});
  }
  return largest;
}

double largestDifference(const pack::Material& m, double thicknessNm, const glm::dvec3& wavelengthsNm) {
  double largest = 0;
  for (int colour = 0; colour < 3; ++colour) {
    const double phase = 2 * thicknessNm / wavelengthsNm[colour];
    const double base = pack::isConductor(m.kind) ? m.eta[colour] : m.eta.y;
    largest = std::max(largest, largestDifference(m, colour, {m.outsideEta, base}, phase));
    if (pack::hasInside(m.kind)) largest = std::max(largest, largestDifference(m, colour, {base, m.outsideEta}, phase));
  }
  return largest;
}

double opticalThickness(const pack::Material& m, double thicknessNm, const glm::dvec3& wavelengthsNm) {
  const glm::dvec3 waves = m.coating.eta * thicknessNm / wavelengthsNm;
  return std::max({waves.x, waves.y, waves.z});
}

}  // namespace

std::optional<FilmPrecision> insufficientFilmPrecision(const pack::Material& m, const glm::dvec3& wavelengthsNm) {
  const double thickness = m.coating.thicknessNm;
  if (thickness <= 0) return std::nullopt;
  const double difference = largestDifference(m, thickness, wavelengthsNm);
  if (difference <= kFilmPrecision) return std::nullopt;
  // The difference grows with the thickness, but not evenly: halve until a film and all thinner ones agree.
  double limit = thickness;
  while (opticalThickness(m, limit, wavelengthsNm) > 0.25 &&
         largestDifference(m, limit, wavelengthsNm) > kFilmPrecision / 2)
    limit /= 2;
  return FilmPrecision{difference, opticalThickness(m, thickness, wavelengthsNm),
                       opticalThickness(m, limit, wavelengthsNm)};
}

}  // namespace malus::bake
