// Exposes a sensor to a rendered image.
#pragma once

#include <cstdint>
#include <vector>

#include "meshprep/base/image.h"
#include "render/sensor/sensor.h"

namespace malus::render {

struct Exposure {
  double exposureEv = 0;  // stops; ignored by a sensor with electronsPerRadiance
  std::uint64_t seed = 0;
  std::uint32_t frame = 0;  // frames of one seed have independent noise
  // Position of the image on the sensor, in pixels; multiples of the pattern's period. A region of an image has the
  // same numbers as in the whole image.
  std::uint32_t x = 0, y = 0;
};

struct RawImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;     // digital numbers, top row first, 0 to 2^bits - 1
  std::vector<std::uint8_t> saturation;  // 255: the pixel has a full well or the largest number; else 0
};

// Throws Error unless width and height are multiples of the pattern's period.
void checkSensorSize(const Sensor& sensor, int width, int height);

// image: channels S0.R ... S2.B of the light before any filter. Equal arguments give equal values, whatever the number
// of threads. Throws Error: a missing channel, a size or position that is not a multiple of the pattern's period.
RawImage expose(const image::Image& image, const Sensor& sensor, const Exposure& exposure);

}  // namespace malus::render
