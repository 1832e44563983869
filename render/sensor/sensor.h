// A division-of-focal-plane polarization sensor: the chain from radiance to digital numbers of each pixel.
//
//   mean electrons   mu = electronsPerRadiance * response * (row . S) + darkSignal
//   charge            n = Poisson(mu), at most fullWell (without shot noise n = mu)
//   digital number   DN = round(blackLevel + (n + Normal(0, readNoise)) / gain), clamped to [0, 2^bits - 1]
//
// S is the Stokes vector of the light before the sensor in the camera frame of the pixel's ray, and row the first row
// of the Mueller matrix of the micro-polarizer: a diattenuator whose principal transmittances are T and T / X, row =
// T/2 (1 + 1/X, (1 - 1/X) cos 2a, (1 - 1/X) sin 2a, 0) (D. Goldstein, Polarized Light: linear diattenuator). The chain
// of noise is the linear camera model of EMVA Standard 1288.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "render/scene/render_parameters.h"
#include "render/sensor/mosaic_pattern.h"

namespace malus::render {

struct Sensor {
  std::string name;    // for people
  std::string source;  // of the figures, for people
  MosaicPattern pattern = MosaicPattern::mono;
  // Of `mono` the weights of R, G and B in the light that it measures; of `quadBayer` the sensitivity of its R, G and B
  // pixels, relative to electronsPerRadiance.
  glm::dvec3 response{1, 1, 1};
  // Per channel; a monochrome sensor uses the first. T: transmittance of a micro-polarizer for light along its axis.
  glm::dvec3 transmission{1, 1, 1};
  // X: T over the transmittance for light across the axis. Infinite: an ideal polarizer.
  glm::dvec3 extinctionRatio{std::numeric_limits<double>::infinity()};
  double fullWell = 0;                         // e-
  double readNoise = 0;                        // e-, standard deviation
  double darkSignal = 0;                       // e-, mean per frame: dark current times exposure time
  bool shotNoise = true;                       // false: charges are their means
  std::uint32_t bits = 0;                      // 8, 10, 12 or 16
  double blackLevel = 0;                       // DN
  std::optional<double> gain;                  // e- per DN; else the full well is the largest number
  std::optional<double> electronsPerRadiance;  // e-; else from the exposure
};

inline constexpr std::array<std::uint32_t, 4> kSensorBits = {8, 10, 12, 16};

constexpr double largestNumber(const Sensor& sensor) {
  return static_cast<double>((std::uint32_t{1} << sensor.bits) - 1);
}

// Electrons per digital number: the sensor's gain, or fullWell / (2^bits - 1 - blackLevel).
double electronsPerNumber(const Sensor& sensor);

// Electrons that unpolarized light of radiance 1 frees in a pixel of response 1 without a polarizer: the sensor's
// value, or fullWell * 2^exposureEv. At exposure 0, it gives half of the full well behind an ideal polarizer, as in
// `--mosaic`. exposureEv: stops.
double electronsPerRadiance(const Sensor& sensor, double exposureEv);

// First row of the Mueller matrix of the micro-polarizer of a channel at an angle.
Analyser polarizerRow(const Sensor& sensor, int channel, double degrees);

// Weights of R, G and B in the light of a channel.
std::array<double, 3> channelWeights(const Sensor& sensor, int channel);

}  // namespace malus::render
