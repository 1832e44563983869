// The raw picture of a division-of-focal-plane polarization camera: every pixel behind a linear polarizer of
// its own, four angles in squares of 2 x 2 pixels, so that demosaicing and shape-from-polarization code can be
// fed with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::render {

// Angle of the polarizer of a pixel in degrees, counter-clockwise from the picture's x; (0, 0) is the file's
// upper left pixel. Rows 90, 45 / 135, 0: the layout of Sony's Polarsens sensors (IMX250MZR, IMX264MZR), here
// without colour filters.
double mosaicDegrees(int x, int y);

// Light that the sensor sees: the luminance (.2126 R + .7152 G + .0722 B) or one colour.
enum class MosaicChannel { luminance, red, green, blue };

struct MosaicSettings {
  unsigned bits = 8;  // 8, 12 or 16
  MosaicChannel channel = MosaicChannel::luminance;
  double exposureEv = 0;  // stops
};

struct Mosaic {
  int width = 0;
  int height = 0;
  unsigned bits = 8;
  std::vector<std::uint16_t> values;  // top row first, 0 to 2^bits - 1
};

// From channels S0.R ... S2.B, of the light before any filter: 1/2 (S0 + S1 cos 2a + S2 sin 2a) times
// 2^exposureEv, where 1 is full scale; linear, cut off at full scale and rounded to the nearest step. Unpolarized
// light of radiance 1 thus reads half of full scale at exposure 0. Width and height must be even, so that every
// square is whole. Throws Error: channels missing, odd size, other numbers of bits.
Mosaic mosaic(const image::Image& picture, const MosaicSettings& settings);

// Grey PNG (.png) or uncompressed TIFF (.tif, .tiff). 12 bits lie in 16 as cameras deliver them (GenICam's
// Mono12): values 0 to 4095, not shifted. Throws Error for another extension, or where it cannot write.
void writeMosaic(const std::filesystem::path& path, const Mosaic& mosaic);

}  // namespace malus::render
