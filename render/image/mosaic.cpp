#include "render/image/mosaic.h"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/image/polarization.h"
#include "render/sensor/expose.h"

namespace malus::render {

namespace {

// A sensor with ideal polarizers and without noise, whose steps are electrons.
Sensor idealSensor(const MosaicSettings& settings) {
  Sensor sensor;
  std::array<double, 3> weights = kLuminanceWeights;
  if (settings.channel != MosaicChannel::luminance) {
    weights = {};
    weights[static_cast<std::size_t>(settings.channel) - static_cast<std::size_t>(MosaicChannel::red)] = 1;
  }
  sensor.response = {weights[0], weights[1], weights[2]};
  sensor.shotNoise = false;
  sensor.bits = settings.bits;
  sensor.fullWell = largestNumber(sensor);
  return sensor;
}

}  // namespace

Mosaic mosaic(const image::Image& image, const MosaicSettings& settings) {
  if (settings.bits != 8 && settings.bits != 12 && settings.bits != 16)
    throw Error("mosaic", "unknown number of bits", "8, 12 or 16", fmt::format("{}", settings.bits));
  if (image.width % 2 != 0 || image.height % 2 != 0)
    throw Error("mosaic", "squares of 2 x 2 pixels do not fill the image", "an even width and height",
                fmt::format("{} x {}", image.width, image.height));
  RawImage raw = expose(image, idealSensor(settings), {.exposureEv = settings.exposureEv});
  return {raw.width, raw.height, settings.bits, std::move(raw.values)};
}

void writeMosaic(const std::filesystem::path& path, const Mosaic& mosaic) {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw Error(path.string(), "unknown format of a mosaic", ".png or .tif",
                extension.empty() ? "no extension" : extension);
  image::writeGrey(path, mosaic.width, mosaic.height,
                   mosaic.bits == 8 ? image::GreyDepth::bits8 : image::GreyDepth::bits16, mosaic.values,
                   fmt::format("polarization mosaic, polarizers in degrees by row: {}, {} bits, linear", kPolarizerRows,
                               mosaic.bits));
}

}  // namespace malus::render
