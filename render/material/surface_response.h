// Response of one smooth interface to polarized light at one angle, by the code that renders (shaders/optics).
#pragma once

#include <array>
#include <optional>

namespace malus::render {

enum class Precision { singlePrecision, doublePrecision };

// Light in a medium of real index n1 arrives at a medium of index n2 - i k2. k2 > 0: a metal, which transmits nothing.
struct Interface {
  double n1 = 1, n2 = 1, k2 = 0;
};

struct SurfaceResponse {
  double angleDegrees = 0;
  double rs = 0, rp = 0;         // reflectance, s and p
  std::optional<double> ts, tp;  // transmittance of the flux, s and p; none for metals
  double diattenuation = 0;      // of the reflection: (R_s - R_p)/(R_s + R_p); 0 if nothing is reflected
  double phaseDegrees = 0;       // arg(r_p conj r_s), in (-180, 180]; frames and signs: shaders/optics/CONVENTIONS.md
  std::array<double, 16> reflection{};  // Mueller matrices, row by row, in flux; x is the s direction on both sides
  std::optional<std::array<double, 16>> transmission;
};

// angleDegrees: angle of incidence, 0 to 90.
SurfaceResponse surfaceResponse(const Interface& interface, double angleDegrees, Precision precision);

}  // namespace malus::render
