// Raw image of an ideal division-of-focal-plane polarization camera without colour filters (render/sensor/sensor.h
// describes the others, mosaic_pattern.h the layout). Input for demosaicing and shape-from-polarization code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::render {

// Light that the sensor measures: the luminance (.2126 R + .7152 G + .0722 B, ITU-R BT.709) or one colour.
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

// Computes 1/2 (S0 + S1 cos 2a + S2 sin 2a) times 2^exposureEv from the channels S0.R ... S2.B, which are of the light
// before any filter; 1 is full scale. Linear, clamped at full scale and rounded to the nearest step: unpolarized light
// of radiance 1 gives half of full scale at exposure 0. Width and height must be even. Throws Error: a missing channel,
// an odd size, another number of bits.
Mosaic mosaic(const image::Image& image, const MosaicSettings& settings);

// Writes a grey PNG (.png) or an uncompressed TIFF (.tif, .tiff). 12 bits are stored in 16 as cameras deliver them
// (GenICam's Mono12): values 0 to 4095, not shifted. Throws Error: another extension, a file that cannot be written.
void writeMosaic(const std::filesystem::path& path, const Mosaic& mosaic);

}  // namespace malus::render
