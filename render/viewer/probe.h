// Numbers of the pixel under the cursor.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "bake/pack/scene.h"
#include "render/ground_truth/ground_truth.h"
#include "render/viewer/published.h"

namespace malus::viewer {

struct ProbedLight {
  std::array<std::array<double, 4>, 3> stokes{};  // S0 to S3 of R, G, B, before the filter
  std::array<double, 3> dolp{}, aolpDegrees{};
  std::array<double, 4> luminance{};  // Stokes vector of the luminance
};

// The light of a pixel of a window of width x height pixels. Nothing: no image there, or one without Stokes vectors.
std::optional<ProbedLight> probeLight(const PublishedSide& side, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                                      std::uint32_t height);

// Polarization ellipse of the polarized part: angle of its major axis and ellipticity angle, both in radians;
// tan(ellipticity) is the ratio of the axes, positive for right circular light. degree: of polarization, 0 to 1.
struct Ellipse {
  double angle = 0, ellipticity = 0, degree = 0;
};
Ellipse ellipse(const std::array<double, 4>& stokes);

struct ProbedSurface {
  std::string material, kind;
  std::uint32_t interactions = 0;
  double distance = 0, incidenceDegrees = 0;
  // Of the reflection at the bare interface at this angle, for R, G, B: (R_s - R_p)/(R_s + R_p); nothing for a surface
  // without an index.
  std::optional<std::array<double, 3>> diattenuation;
};
// Nothing: the pixel sees the environment.
std::optional<ProbedSurface> probeSurface(const render::PixelTruth& truth, const pack::Scene& scene);

}  // namespace malus::viewer
