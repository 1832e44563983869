#include "render/sensor/raw_output.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "render/sensor/demosaic.h"

namespace malus::render {
using nlohmann::json;

namespace {

// Evaluates value(x, y) over one period of the pattern, as rows.
template <class Value>
json patternRows(int period, const Value& value) {
  json rows = json::array();
  for (int y = 0; y < period; ++y) {
    json row = json::array();
    for (int x = 0; x < period; ++x) row.push_back(value(x, y));
    rows.push_back(row);
  }
  return rows;
}

const char* channelName(MosaicPattern pattern, int channel) {
  constexpr const char* kColours[] = {"R", "G", "B"};
  return pattern == MosaicPattern::mono ? "Y" : kColours[channel];
}

json describeChannel(const Sensor& sensor, int channel) {
  json rows = json::array();
  for (const double degrees : kPolarizerDegrees) {
    const Analyser row = polarizerRow(sensor, channel, degrees);
    rows.push_back({row[0], row[1], row[2]});
  }
  const bool isMono = sensor.pattern == MosaicPattern::mono;
  return {{"name", channelName(sensor.pattern, channel)},
          {"response",
           isMono ? json({sensor.response.x, sensor.response.y, sensor.response.z}) : json(sensor.response[channel])},
          {"transmission", sensor.transmission[channel]},
          {"extinctionRatio", sensor.extinctionRatio[channel]},
          {"rows", rows},
          {"dataReduction", dataReduction(sensor, channel)}};
}

void writeNumbers(const std::filesystem::path& path, const RawImage& raw) {
  image::Image image;
  image.width = raw.width;
  image.height = raw.height;
  image.channels = {"Y"};
  image.pixels.assign(raw.values.begin(), raw.values.end());
  image::writeExr(path, image);
}

}  // namespace

void writeRaw(const std::filesystem::path& path, const RawImage& raw, const Sensor& sensor) {
  const std::string extension = path.extension().string();
  if (extension == ".exr") return writeNumbers(path, raw);
  if (extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw Error(path.string(), "unknown format of a raw image", ".png, .tif or .exr",
                extension.empty() ? "no extension" : extension);
  image::writeGrey(
      path, raw.width, raw.height, sensor.bits == 8 ? image::GreyDepth::bits8 : image::GreyDepth::bits16, raw.values,
      fmt::format("raw image of a polarization sensor, pattern {}, polarizers in degrees by row: {}, {} bits, "
                  "black level {:g}, linear",
                  kMosaicPatternNames[static_cast<std::size_t>(sensor.pattern)], kPolarizerRows, sensor.bits,
                  sensor.blackLevel));
}

void writeSaturation(const std::filesystem::path& path, const RawImage& raw) {
  image::writePng(path, raw.width, raw.height, 1, raw.saturation);
}

void writeSensorStokes(const std::filesystem::path& path, const RawImage& raw, const Sensor& sensor, double exposureEv,
                       const image::Image& rendered, image::ExrCompression compression) {
  image::Image stokes = demosaic(raw, sensor, exposureEv);
  stokes.attributes = rendered.attributes;
  stokes.attributes.emplace_back("malus:sensor", sensor.name);
  image::writeExr(path, stokes, compression);
}

std::filesystem::path rawDescriptionFile(const std::filesystem::path& raw) {
  std::filesystem::path file = raw;
  return file.replace_extension(".json");
}

json describeRaw(const RawImage& raw, const Sensor& sensor, const Exposure& exposure, json scene) {
  json channels = json::array();
  for (int c = 0; c < channelCount(sensor.pattern); ++c) channels.push_back(describeChannel(sensor, c));
  const auto saturated = std::count(raw.saturation.begin(), raw.saturation.end(), std::uint8_t{255});
  return {{"malus", 1},
          {"name", sensor.name},
          {"source", sensor.source},
          {"width", raw.width},
          {"height", raw.height},
          {"bits", sensor.bits},
          {"pattern", kMosaicPatternNames[static_cast<std::size_t>(sensor.pattern)]},
          {"polarizerDegrees", patternRows(2, polarizerDegrees)},
          {"channelPattern",
           patternRows(patternPeriod(sensor.pattern),
                       [&](int x, int y) { return channelName(sensor.pattern, mosaicChannel(sensor.pattern, x, y)); })},
          {"channels", channels},
          {"blackLevel", sensor.blackLevel},
          {"gain", electronsPerNumber(sensor)},
          {"electronsPerRadiance", electronsPerRadiance(sensor, exposure.exposureEv)},
          {"fullWell", sensor.fullWell},
          {"readNoise", sensor.readNoise},
          {"darkSignal", sensor.darkSignal},
          {"shotNoise", sensor.shotNoise},
          {"seed", exposure.seed},
          {"frame", exposure.frame},
          {"x", exposure.x},
          {"y", exposure.y},
          {"saturatedPixels", saturated},
          {"image", std::move(scene)}};
}

}  // namespace malus::render
