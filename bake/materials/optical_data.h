// The complex index n - i k of a material over the wavelength in vacuum, from published tables and formulas.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::bake {

// The index eta - i k at the wavelengths of red, green and blue.
struct OpticalConstants {
  glm::dvec3 eta{1.0}, k{0.0};
};

class OpticalData {
 public:
  enum class Quantity { n, k };

  // A row of a table.
  struct Row {
    double micrometres, value;
  };

  // where: the source, for errors.
  explicit OpticalData(std::string where) : where_(std::move(where)) {}

  // Adds a table, in any order; between its rows values are interpolated linearly in the wavelength. Throws Error if it
  // has no row, a wavelength of 0 or less, a value under 0, or two values at one wavelength. location: of the table.
  void addTable(Quantity quantity, std::vector<Row> rows, const std::string& location);

  // Adds a dispersion formula of n (bake/materials/dispersion.h) for wavelengths from low to high. Throws Error if
  // there is no such formula, or the number of coefficients or the range does not fit.
  void addFormula(int formula, std::vector<double> coefficients, double low, double high, const std::string& location);

  bool has(Quantity quantity) const;

  // The first curve of the quantity that covers the wavelength. k is 0 if the data have none. Throws Error outside of
  // the ranges, as nothing is extrapolated, and where a formula has no value from 0 to 1000.
  double at(Quantity quantity, double nanometres) const;
  OpticalConstants at(const glm::dvec3& nanometres) const;

 private:
  struct Curve {
    Quantity quantity;
    double low, high;  // micrometres
    std::vector<Row> rows;
    int formula = 0;  // 0: the rows
    std::vector<double> coefficients;
    double at(double micrometres) const;
  };
  std::string ranges(Quantity quantity) const;

  std::string where_;
  std::vector<Curve> curves_;
};

}  // namespace malus::bake
