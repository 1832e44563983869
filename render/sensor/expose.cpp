#include "render/sensor/expose.h"

#include <array>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "meshprep/base/error.h"
#include "render/image/polarization.h"
#include "render/sensor/noise.h"
#include "render/sensor/quantization.h"

namespace malus::render {

namespace {

// Row of the Mueller matrix, and weights of the colours, of each channel.
struct Channel {
  std::array<Analyser, kPolarizerAngles> rows;
  std::array<double, 3> weights;
};

std::vector<Channel> channels(const Sensor& sensor) {
  std::vector<Channel> result;
  for (int c = 0; c < channelCount(sensor.pattern); ++c) {
    Channel channel{{}, channelWeights(sensor, c)};
    for (std::size_t a = 0; a < kPolarizerDegrees.size(); ++a)
      channel.rows[a] = polarizerRow(sensor, c, kPolarizerDegrees[a]);
    result.push_back(channel);
  }
  return result;
}

void checkMultiple(const Sensor& sensor, const char* quantity, const char* expected, int a, int b) {
  const int period = patternPeriod(sensor.pattern);
  if (a % period != 0 || b % period != 0)
    throw Error("sensor", fmt::format("{} not a multiple of the pattern's period", quantity),
                fmt::format("{} that are multiples of {}", expected, period), fmt::format("{} x {}", a, b));
}

}  // namespace

void checkSensorSize(const Sensor& sensor, int width, int height) {
  checkMultiple(sensor, "the size of the image is", "a width and a height", width, height);
}

RawImage expose(const image::Image& image, const Sensor& sensor, const Exposure& exposure) {
  checkSensorSize(sensor, image.width, image.height);
  checkMultiple(sensor, "the position of the image is", "coordinates", static_cast<int>(exposure.x),
                static_cast<int>(exposure.y));
  const StokesChannels stokes(image);
  const std::vector<Channel> channel = channels(sensor);
  const double scale = electronsPerRadiance(sensor, exposure.exposureEv);
  const Quantizer quantize{sensor.blackLevel, electronsPerNumber(sensor), largestNumber(sensor)};
  const auto width = static_cast<std::size_t>(image.width), count = width * static_cast<std::size_t>(image.height);
  RawImage raw{image.width, image.height, std::vector<std::uint16_t>(count), std::vector<std::uint8_t>(count)};
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, image.height), [&](const auto& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y)
      for (int x = 0; x < image.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        const Channel& c = channel[static_cast<std::size_t>(mosaicChannel(sensor.pattern, x, y))];
        const Analyser& a = c.rows[static_cast<std::size_t>(polarizerIndex(x, y))];
        const std::array<double, 3> s = stokes.weighted(i, c.weights);
        PhiloxStream random(exposure.seed, exposure.frame, exposure.x + static_cast<std::uint32_t>(x),
                            exposure.y + static_cast<std::uint32_t>(y));
        const double mean = scale * (a[0] * s[0] + a[1] * s[1] + a[2] * s[2]) + sensor.darkSignal;
        const double charge = drawCharge(sensor, mean, random);
        raw.values[i] = quantize(charge + drawReadNoise(sensor, random));
        const bool isSaturated = charge >= sensor.fullWell || raw.values[i] >= quantize.largestNumber;
        raw.saturation[i] = isSaturated ? 255 : 0;
      }
  });
  return raw;
}

}  // namespace malus::render
