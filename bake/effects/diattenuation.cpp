#include "bake/effects/diattenuation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "bake/effects/query.h"
#include "shaders/optics/optics.h"

namespace malus::bake {
using pack::Material;

namespace {

constexpr std::size_t kCells = 2000;

double ratio(double a, double b) { return a + b > 0 ? std::abs(a - b) / (a + b) : 0; }

std::vector<double> constant(double value) { return std::vector<double>(kCells, value); }

std::size_t findCell(double cosine) { return std::min(kCells - 1, static_cast<std::size_t>(cosine * kCells)); }

// Over both sides of an interface between n1 and n2: of reflection, and of transmission if it transmits or light
// leaves.
struct Cells {
  std::vector<double> reflection = constant(0), transmission = constant(0);

  void add(double n1, double n2, double k2) {
    double reflected = 0, transmitted = 0;
    for (std::size_t i = 0; i <= kCells; ++i) {
      const double c = static_cast<double>(i) / kCells;
      const f64::Reflectance r =
          k2 > 0 ? f64::conductorReflectance(c, n1, n2, k2) : f64::dielectricReflectance(c, n1, n2);
      const double nextReflected = ratio(r.rs, r.rp), nextTransmitted = ratio(1 - r.rs, 1 - r.rp);
      if (i > 0) {
        reflection[i - 1] = std::max({reflection[i - 1], reflected, nextReflected});
        transmission[i - 1] = std::max({transmission[i - 1], transmitted, nextTransmitted});
      }
      reflected = nextReflected;
      transmitted = nextTransmitted;
    }
    if (k2 > 0 || n1 == n2) return;
    // At grazing incidence or the critical angle the transmittances tend to 0 in the ratio n1^2 : n2^2.
    const double square = (n1 - n2) * (n1 + n2);
    double& last = transmission[n1 > n2 ? findCell(std::sqrt(square) / n1) : 0];
    last = std::max(last, std::abs(square) / (n1 * n1 + n2 * n2));
    // At Brewster's angle, within a cell, the reflection is fully polarized.
    reflection[findCell(n1 / std::hypot(n1, n2))] = 1;
  }
};

}  // namespace

RangeMaximum::RangeMaximum(std::vector<double> cells) {
  levels_.push_back(std::move(cells));
  for (std::size_t width = 1; 2 * width <= levels_[0].size(); width *= 2) {
    const std::vector<double>& last = levels_.back();
    std::vector<double> next(last.size() - width);
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = std::max(last[i], last[i + width]);
    levels_.push_back(std::move(next));
  }
}

double RangeMaximum::over(const CosineRange& range) const {
  if (range.isEmpty() || levels_.empty()) return 0;
  const std::size_t count = levels_[0].size();
  const auto cell = [&](double c) {
    return std::min(count - 1, static_cast<std::size_t>(std::clamp(c, 0.0, 1.0) * static_cast<double>(count)));
  };
  const std::size_t first = cell(range.low), last = std::max(first, cell(range.high));
  const std::size_t level = std::bit_width(last - first + 1) - 1;
  return std::max(levels_[level][first], levels_[level][last + 1 - (std::size_t{1} << level)]);
}

Diattenuation diattenuation(const Material& m, int colour) {
  const bool leaves = m.albedo[colour] > 0 || m.radiance[colour] > 0 || m.meshMaps.albedo.isUsed();
  if (pack::isPolarizingElement(m.kind))
    return {RangeMaximum(constant(ratio(m.transmittanceParallel[colour], m.transmittanceCrossed[colour]))),
            RangeMaximum(constant(0))};
  // Films, coats, panes and maps: their maximum is not bounded by samples.
  if (m.kind == pack::MaterialKind::thinGlass || isCoated(m) || hasClearCoat(m) || m.maps.eta >= 0 ||
      m.meshMaps.eta.isUsed() || m.meshMaps.reflectance.isUsed())
    return {RangeMaximum(constant(1)), RangeMaximum(constant(leaves ? 1 : 0))};
  Cells cells;
  if (pack::isConductor(m.kind))
    cells.add(m.outsideEta, m.eta[colour], m.k[colour]);
  else
    cells.add(m.outsideEta, m.eta.y, 0);
  std::vector<double> leaving = leaves ? cells.transmission : constant(0);
  if (!pack::isConductor(m.kind) && pack::hasInside(m.kind)) cells.add(m.eta.y, m.outsideEta, 0);
  if (pack::transmits(m.kind))
    for (std::size_t i = 0; i < kCells; ++i) cells.reflection[i] = std::max(cells.reflection[i], cells.transmission[i]);
  return {RangeMaximum(std::move(cells.reflection)), RangeMaximum(std::move(leaving))};
}

}  // namespace malus::bake
