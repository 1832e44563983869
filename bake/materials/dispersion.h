// Dispersion formulas: the index of refraction over the wavelength in vacuum.
//
// Numbers and coefficients are those of the refractiveindex.info database, "Dispersion formulas" (M. N. Polyanskiy,
// Sci. Data 11, 94, 2024). L is the wavelength in micrometres, C1, C2, ... are the coefficients; missing ones are 0.
//   1  Sellmeier            n^2 - 1 = C1 + C2 L^2/(L^2 - C3^2) + C4 L^2/(L^2 - C5^2) + ...
//   2  Sellmeier-2          n^2 - 1 = C1 + C2 L^2/(L^2 - C3) + C4 L^2/(L^2 - C5) + ...
//   3  polynomial           n^2 = C1 + C2 L^C3 + C4 L^C5 + ...
//   4  RefractiveIndex.INFO n^2 = C1 + C2 L^C3/(L^2 - C4^C5) + C6 L^C7/(L^2 - C8^C9) + C10 L^C11 + C12 L^C13 + ...
//   5  Cauchy               n = C1 + C2 L^C3 + C4 L^C5 + ...
//   6  gases                n - 1 = C1 + C2/(C3 - L^-2) + C4/(C5 - L^-2) + ...
//   7  Herzberger           n = C1 + C2/(L^2 - 0.028) + C3/(L^2 - 0.028)^2 + C4 L^2 + C5 L^4 + C6 L^6
//   8  retro                (n^2 - 1)/(n^2 + 2) = C1 + C2 L^2/(L^2 - C3) + C4 L^2
//   9  exotic               n^2 = C1 + C2/(L^2 - C3) + C4 (L - C5)/((L - C5)^2 + C6)
#pragma once

#include <cstddef>
#include <span>

namespace malus::bake {

inline constexpr int kDispersionFormulas = 9;

// Whether a formula, 1 to 9, may have so many coefficients: C1, and whole terms of a sum, at most twenty.
bool hasCompleteTerms(int formula, std::size_t coefficients);

// Returns the index at a wavelength over 0; NaN or infinite where the formula has no value. The number of coefficients
// must be that of complete terms.
double indexByFormula(int formula, std::span<const double> coefficients, double micrometres);

}  // namespace malus::bake
