// Fuzzes the reader of sensor files, and exposes every sensor that it accepts.
#include <string>

#include "meshprep/base/error.h"
#include "render/sensor/demosaic.h"
#include "render/sensor/expose.h"
#include "render/sensor/raw_output.h"
#include "render/sensor/sensor_file.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/temporary.h"

namespace {

// Radiance from 0 to more than any full well, partly polarized, over 4 x 4 pixels.
malus::image::Image testImage() {
  malus::image::Image image;
  image.width = image.height = 4;
  for (const char* s : {"S0", "S1", "S2"})
    for (const char* c : {"R", "G", "B"}) image.channels.push_back(std::string(s) + "." + c);
  for (int i = 0; i < 16; ++i)
    for (int c = 0; c < 9; ++c)
      image.pixels.push_back((c < 3 ? 1.0f : 0.4f) * (i < 14 ? 0.1f * static_cast<float>(i) : i == 14 ? 1e30f : -1.0f));
  return image;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const malus::image::Image image = testImage();
  try {
    const malus::render::Sensor sensor = malus::render::readSensor(writeTemporary(data, size, ".json").string());
    const malus::render::Exposure exposure{};
    const malus::render::RawImage raw = malus::render::expose(image, sensor, exposure);
    malus::render::demosaic(raw, sensor, exposure.exposureEv);
    malus::render::describeRaw(raw, sensor, exposure, {}).dump();
  } catch (const malus::Error&) {
  }
  return 0;
}
