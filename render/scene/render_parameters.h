// Settings of an image that are not in the pack: size, region, depth, filter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "bake/pack/scene.h"
#include "render/scene/embree_path.h"
#include "render/scene/vulkan_path.h"

namespace malus::render {

// A part of the image, in pixels from the upper left corner.
struct Region {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

// First row of the Mueller matrix of the filter in front of the camera: the recorded intensity is its product with the
// Stokes vector in the camera frame (shaders/optics/CONVENTIONS.md: x is that of the image, angles are in degrees,
// counter-clockwise seen by the photographer; +S3 is right circular).
using Analyser = std::array<double, 4>;
inline constexpr Analyser kNoFilter = {1, 0, 0, 0};
// Linear polarizer that passes light along an axis at `degrees`: 1/2 (1, cos 2f, sin 2f, 0), any finite angle.
// A photographer's "circular polarizer" is this one: its quarter-wave plate is behind the polarizer.
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

inline constexpr std::uint32_t kMostLightSamples = 256;

struct RenderParameters {
  std::uint32_t width = 0;  // of the whole image
  std::uint32_t height = 0;
  Region region;
  std::uint32_t samples = 1;  // rays per pixel along each axis
  std::uint32_t depth = 0;    // most specular interactions along a path
  Analyser analyser = kNoFilter;
  bool shadows = true;             // false: nothing blocks a point light
  bool filteredShadows = true;     // false: thin surfaces that transmit block lights, too
  std::uint32_t lightSamples = 4;  // of area lights, and of the environment, at each hit; 1 to kMostLightSamples
  bool everyEffect = false;        // compile in every effect, even those that the scene does not need
  double tolerance = 0;            // of iterative methods: share of a source's radiance that a path may lose
  bool stokes = false;             // of iterative methods: Stokes vectors too, by four analysers
  bool checkNumerics = false;      // find unphysical values (fault.h); slow
  VulkanPath vulkanPath = VulkanPath::automatic;  // of the Vulkan renderer; ignored by others
  EmbreePath embreePath = EmbreePath::automatic;  // of the Embree renderer; ignored by others
};

// The settings of the pack.
RenderParameters defaultParameters(const pack::Scene& scene);

}  // namespace malus::render
