// Layout of the filters on a division-of-focal-plane sensor. The only place that defines it.
//
// Micro-polarizers are in squares of 2 x 2 pixels, by rows 90, 45 / 135, 0 degrees, counter-clockwise from the x axis
// of the image: the layout of Sony's Polarsens sensors (IMX250MZR, IMX264MZR, IMX250MYR). A colour sensor has quad
// Bayer filters: each colour covers a square of micro-polarizers, by rows R, G / G, B of squares, so that the pattern
// repeats every 4 x 4 pixels. (0, 0) is the upper left pixel.
#pragma once

#include <array>

namespace malus::render {

enum class MosaicPattern { mono, quadBayer };
inline constexpr std::array<const char*, 2> kMosaicPatternNames = {"mono", "quad-bayer"};

inline constexpr int kPolarizerAngles = 4;
// Angles in degrees, by the index 2 * (y mod 2) + x mod 2 of a pixel.
inline constexpr std::array<double, kPolarizerAngles> kPolarizerDegrees = {90, 45, 135, 0};
inline constexpr const char* kPolarizerRows = "90 45 / 135 0";  // the same as text
// Colours (0, 1, 2 for R, G, B) by the same index of a square of pixels.
inline constexpr std::array<int, 4> kBayerColours = {0, 1, 1, 2};

constexpr int polarizerIndex(int x, int y) { return 2 * (y & 1) + (x & 1); }
constexpr double polarizerDegrees(int x, int y) {
  return kPolarizerDegrees[static_cast<unsigned>(polarizerIndex(x, y))];
}

// Channels of the sensor: one, or R, G, B.
constexpr int channelCount(MosaicPattern pattern) { return pattern == MosaicPattern::mono ? 1 : 3; }
// Channel that a pixel measures.
constexpr int mosaicChannel(MosaicPattern pattern, int x, int y) {
  return pattern == MosaicPattern::mono ? 0 : kBayerColours[static_cast<unsigned>(polarizerIndex(x >> 1, y >> 1))];
}

// Period of the pattern in pixels, in both directions: 2 or 4.
constexpr int patternPeriod(MosaicPattern pattern) { return pattern == MosaicPattern::mono ? 2 : 4; }

}  // namespace malus::render
