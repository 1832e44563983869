#include "bake/materials/optical_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bake/materials/dispersion.h"
#include "bake/pack/scene.h"
#include "meshprep/base/error.h"

namespace malus::bake {

namespace {

constexpr double kRounding = 1e-9;  // relative, of a wavelength that is converted from nanometres

std::string_view quantityName(OpticalData::Quantity quantity) {
  return quantity == OpticalData::Quantity::n ? "n" : "k";
}

}  // namespace

void OpticalData::addTable(Quantity quantity, std::vector<Row> rows, const std::string& location) {
  if (rows.empty()) throw Error(location, fmt::format("table of {} has no rows", quantityName(quantity)));
  for (const Row& row : rows) {
    if (!(row.micrometres > 0))
      throw Error(location, "wavelength is not positive", "", fmt::to_string(row.micrometres));
    if (!(row.value >= 0 && row.value <= pack::kMaxEta))
      throw Error(location, fmt::format("{} is out of range", quantityName(quantity)),
                  fmt::format("0 to {}", pack::kMaxEta), fmt::to_string(row.value));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.micrometres < b.micrometres; });
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].micrometres == rows[i - 1].micrometres && rows[i].value != rows[i - 1].value)
      throw Error(location, fmt::format("two values of {} at {} um", quantityName(quantity), rows[i].micrometres),
                  "one value", fmt::format("{} and {}", rows[i - 1].value, rows[i].value));
  const double low = rows.front().micrometres, high = rows.back().micrometres;
  curves_.push_back({quantity, low, high, std::move(rows), 0, {}});
}

void OpticalData::addFormula(int formula, std::vector<double> coefficients, double low, double high,
                             const std::string& location) {
  if (formula < 1 || formula > kDispersionFormulas)
    throw Error(location, "unknown dispersion formula", fmt::format("1 to {}", kDispersionFormulas),
                fmt::to_string(formula));
  if (!hasCompleteTerms(formula, coefficients.size()))
    throw Error(location, fmt::format("wrong number of coefficients of formula {}", formula),
                "C1 and the complete terms of the formula", fmt::to_string(coefficients.size()));
  if (!(low > 0 && low <= high))
    throw Error(location, "range of wavelengths is empty", "two increasing wavelengths over 0 in micrometres",
                fmt::format("{} to {}", low, high));
  curves_.push_back({Quantity::n, low, high, {}, formula, std::move(coefficients)});
}

bool OpticalData::has(Quantity quantity) const {
  return std::any_of(curves_.begin(), curves_.end(), [&](const Curve& c) { return c.quantity == quantity; });
}

double OpticalData::Curve::at(double micrometres) const {
  if (formula != 0) return indexByFormula(formula, coefficients, micrometres);
  const double wavelength = std::clamp(micrometres, low, high);
  const auto above = std::lower_bound(rows.begin(), rows.end(), wavelength,
                                      [](const Row& row, double value) { return row.micrometres < value; });
  if (above->micrometres == wavelength || above == rows.begin()) return above->value;
  const Row &a = *(above - 1), &b = *above;
  return a.value + (b.value - a.value) * (wavelength - a.micrometres) / (b.micrometres - a.micrometres);
}

std::string OpticalData::ranges(Quantity quantity) const {
  std::string text;
  for (const Curve& curve : curves_)
    if (curve.quantity == quantity)
      text += fmt::format("{}{:g} to {:g} nm", text.empty() ? "" : ", ", 1e3 * curve.low, 1e3 * curve.high);
  return text;
}

double OpticalData::at(Quantity quantity, double nanometres) const {
  const double micrometres = nanometres / 1e3;
  for (const Curve& curve : curves_) {
    if (curve.quantity != quantity || micrometres < curve.low * (1 - kRounding) ||
        micrometres > curve.high * (1 + kRounding))
      continue;
    const double value = curve.at(micrometres);
    if (!(value >= 0 && value <= pack::kMaxEta))
      throw Error(where_, fmt::format("formula {} has no index of refraction at {:g} nm", curve.formula, nanometres),
                  fmt::format("0 to {}", pack::kMaxEta), fmt::to_string(value));
    return value;
  }
  if (quantity == Quantity::k && !has(Quantity::k)) return 0;
  throw Error(where_, fmt::format("{} is not known at {:g} nm", quantityName(quantity), nanometres),
              fmt::format("a wavelength of {}", ranges(quantity)));
}

OpticalConstants OpticalData::at(const glm::dvec3& nanometres) const {
  OpticalConstants constants;
  for (int c = 0; c < 3; ++c) {
    constants.eta[c] = at(Quantity::n, nanometres[c]);
    constants.k[c] = at(Quantity::k, nanometres[c]);
  }
  return constants;
}

}  // namespace malus::bake
