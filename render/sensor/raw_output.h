// Files of a raw image: the numbers, the mask of saturated pixels, the Stokes vectors that follow from them, and a JSON
// file with what is needed to interpret them.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "meshprep/base/image.h"
#include "render/sensor/expose.h"
#include "render/sensor/sensor.h"

namespace malus::render {

// Writes a grey PNG (.png) or an uncompressed TIFF (.tif, .tiff) of integers, unscaled, 10 and 12 bits in 16 (GenICam
// Mono10, Mono12), or .exr with the numbers as floats in the channel Y. Throws Error: another extension, a file that
// cannot be written.
void writeRaw(const std::filesystem::path& path, const RawImage& raw, const Sensor& sensor);

// Writes the mask as an 8-bit PNG: 255 for saturated pixels, else 0.
void writeSaturation(const std::filesystem::path& path, const RawImage& raw);

// Writes the Stokes vectors that are demosaicked from the raw image, with the attributes of the
// rendered image.
void writeSensorStokes(const std::filesystem::path& path, const RawImage& raw, const Sensor& sensor, double exposureEv,
                       const image::Image& rendered, image::ExrCompression compression);

// Name of the JSON file of a raw image: the same with the extension .json.
std::filesystem::path rawDescriptionFile(const std::filesystem::path& raw);

// Contents of that file; render/sensor/SENSOR.md describes them. scene: keys about the rendered image, an object.
nlohmann::json describeRaw(const RawImage& raw, const Sensor& sensor, const Exposure& exposure, nlohmann::json scene);

}  // namespace malus::render
