// What a user asks of a picture beside the pack: size, part, depth, filter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "bake/pack/scene.h"

namespace malus::render {

// A part of the picture, in pixels from the upper left corner.
struct Region {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

// First row of the Mueller matrix of what stands in front of the camera: the recorded intensity is its
// product with the Stokes vector in the camera's frame (shaders/optics/CONVENTIONS.md: x is the picture's,
// angles in degrees, counter-clockwise as the photographer sees them; +S3 is right circular).
using Analyser = std::array<double, 4>;
inline constexpr Analyser kNoFilter = {1, 0, 0, 0};
// Linear polarizer that passes light along an axis at `degrees`: 1/2 (1, cos 2f, sin 2f, 0), any finite angle.
// A photographer's "circular polarizer" is this one: its quarter-wave plate stands behind the polarizer.
Analyser linearPolarizer(double degrees);

// Circular analyser that passes right or left circular light: 1/2 (1, 0, 0, +-1).
enum class Handedness { right, left };
Analyser circularAnalyser(Handedness handedness);

// Linear retarder: fast axis and retardance in degrees, any finite angles. 90 is a quarter-wave plate.
struct WavePlate {
  double axisDegrees = 0;
  double retardanceDegrees = 90;
};
// The plate in front of an analyser (toward the scene): the analyser's row times R(-a) G(d) R(a), where R turns
// the frame and G is [[cos d, sin d], [-sin d, cos d]] on (S2, S3). The plate alone changes no intensity.
Analyser behindWavePlate(const Analyser& analyser, const WavePlate& plate);

struct RenderParameters {
  std::uint32_t width = 0;  // of the whole picture
  std::uint32_t height = 0;
  Region region;
  std::uint32_t samples = 1;  // rays per pixel along each axis
  std::uint32_t depth = 0;    // most specular interactions along a path
  Analyser analyser = kNoFilter;
  bool shadows = true;       // false: nothing blocks a point light
  bool everyEffect = false;  // compile in every effect, whether the scene calls for it or not
  double tolerance = 0;      // of methods that follow the eye's path: share of a source's radiance that a path may lose
  bool stokes = false;       // of those: Stokes vectors too, by four analysers
  bool checkNumerics = false;  // look for values that no light can have (fault.h); slow
};

// The pack's own view.
RenderParameters defaultParameters(const pack::Scene& scene);

}  // namespace malus::render
