// Demosaicing without noise returns the Stokes image, and the sensor's pixels are those of Malus's law with leakage.
#include "render/sensor/demosaic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "meshprep/base/error.h"
#include "render/image/polarization.h"
#include "tests/render/sensor/stokes_image.h"

namespace malus::render {
namespace {

using Stokes = std::array<double, 3>;
constexpr double kPi = std::numbers::pi;

Sensor noiseless(MosaicPattern pattern) {
  Sensor sensor;
  sensor.pattern = pattern;
  sensor.response = {0.5, 0.9, 0.7};
  sensor.transmission = {0.8, 0.6, 0.4};
  sensor.extinctionRatio = {5, 20, 300};
  sensor.shotNoise = false;
  sensor.fullWell = 1e6;
  sensor.bits = 16;
  sensor.blackLevel = 100;
  sensor.electronsPerRadiance = 7e5;
  return sensor;
}

// S0, S1, S2 of a channel that the sensor should find: of one colour, or of the weighted sum.
Stokes expected(const Sensor& sensor, const image::Image& image, int x, int y, int channel) {
  std::array<double, 3> weights{};
  if (sensor.pattern == MosaicPattern::mono)
    weights = {sensor.response.x, sensor.response.y, sensor.response.z};
  else
    weights[static_cast<std::size_t>(channel)] = 1;
  return StokesChannels(image).weighted(static_cast<std::size_t>(y * image.width + x), weights);
}

// Sum of the absolute values of a row of the data reduction matrix.
double rowSum(const Sensor& sensor, int channel, int component) {
  const DataReduction reduction = dataReduction(sensor, channel);
  double sum = 0;
  for (const double d : reduction[static_cast<std::size_t>(component)]) sum += std::abs(d);
  return sum;
}

// Error of the result that half a step of each number causes at most, and the rounding of floats.
double quantizationBound(const Sensor& sensor, int channel, int component) {
  const double response = sensor.pattern == MosaicPattern::mono ? 1 : sensor.response[channel];
  return rowSum(sensor, channel, component) *
         (0.5 * electronsPerNumber(sensor) / (*sensor.electronsPerRadiance * response) + 1e-6);
}

// Compares the demosaicked image with the one that the sensor saw. margin: pixels at the border that are left out;
// interpolation: error of the light of an angle by interpolation.
void expectStokes(const Sensor& sensor, const image::Image& image, int margin, double interpolation = 0) {
  const image::Image found = demosaic(expose(image, sensor, {}), sensor, 0);
  const int channels = channelCount(sensor.pattern);
  ASSERT_EQ(found.channels.size(), static_cast<std::size_t>(4 * channels));
  for (int y = margin; y < image.height - margin; ++y)
    for (int x = margin; x < image.width - margin; ++x)
      for (int c = 0; c < channels; ++c) {
        const Stokes truth = expected(sensor, image, x, y, c);
        const float* const pixel =
            found.pixels.data() + static_cast<std::ptrdiff_t>(4 * channels * (y * image.width + x));
        EXPECT_EQ(pixel[c], pixel[channels + c]);
        for (int s = 0; s < 3; ++s) {
          ASSERT_NEAR(static_cast<double>(pixel[channels * (s + 1) + c]), truth[static_cast<std::size_t>(s)],
                      quantizationBound(sensor, c, s) + rowSum(sensor, c, s) * interpolation)
              << x << " " << y << ", channel " << c << ", S" << s;
        }
      }
}

constexpr MosaicPattern kPatterns[] = {MosaicPattern::mono, MosaicPattern::quadBayer};

TEST(SensorDemosaic, FlatLightIsReturned) {
  for (const MosaicPattern pattern : kPatterns)
    for (const double dolp : {0.0, 0.3, 1.0})
      for (const double degrees : {0.0, 30.0, 45.0, 90.0, 100.0, 160.0}) {
        SCOPED_TRACE(testing::Message() << "DoLP " << dolp << ", " << degrees << " degrees");
        const auto light = [&](int, int, int c) {
          const double s0 = 0.3 + 0.2 * c, aolp = degrees * kPi / 180 + 0.1 * c;
          return Stokes{s0, s0 * dolp * std::cos(2 * aolp), s0 * dolp * std::sin(2 * aolp)};
        };
        Sensor sensor = noiseless(pattern);
        sensor.darkSignal = dolp * 1e5;
        expectStokes(sensor, stokesImage(12, 8, light), 0);
      }
}

TEST(SensorDemosaic, LinearImagesAreReturnedInside) {
  const auto light = [](int x, int y, int c) {
    return Stokes{0.4 + 0.003 * x + 0.005 * y + 0.01 * c, 0.1 - 0.002 * x + 0.001 * y, -0.05 + 0.001 * x - 0.004 * y};
  };
  expectStokes(noiseless(MosaicPattern::mono), stokesImage(40, 32, light), 2);
  expectStokes(noiseless(MosaicPattern::quadBayer), stokesImage(40, 32, light), 4);
}

TEST(SensorDemosaic, SmoothImagesAreReturnedWithinTheInterpolationError) {
  // Linear interpolation between samples at a distance h errs by at most h^2/8 max |f''| in each direction.
  const double frequency = 2 * kPi / 64, amplitude = 0.1;
  const auto light = [&](int x, int y, int c) {
    const double wave = amplitude * std::sin(frequency * x + c) * std::cos(frequency * y);
    return Stokes{0.5 + wave, 0.5 * wave, 0.2 - 0.5 * wave};
  };
  for (const MosaicPattern pattern : kPatterns) {
    const Sensor sensor = noiseless(pattern);
    const double h = patternPeriod(pattern);
    // Light behind a polarizer of the most transmitting channel: at most T/2 (1 + 1/X) wave + T/2 wave.
    const double light2 =
        sensor.transmission.x * amplitude * frequency * frequency * (pattern == MosaicPattern::mono ? 2.1 : 1.0);
    expectStokes(sensor, stokesImage(64, 64, light), 4, 2 * h * h / 8 * light2);
  }
}

TEST(SensorDemosaic, RowsAndColumnsAreTreatedAlike) {
  // Both patterns are symmetric; unpolarized light does not distinguish the angles.
  for (const MosaicPattern pattern : kPatterns) {
    const auto found = [&](bool isTransposed) {
      const auto light = [&](int x, int y, int) {
        return Stokes{0.1 + 1e-3 * std::pow(isTransposed ? y : x, 2), 0, 0};
      };
      return demosaic(expose(stokesImage(16, 16, light), noiseless(pattern), {}), noiseless(pattern), 0);
    };
    const image::Image rows = found(false), columns = found(true);
    const std::size_t channels = rows.channels.size();
    for (std::size_t y = 0; y < 16; ++y)
      for (std::size_t x = 0; x < 16; ++x)
        for (std::size_t c = 0; c < channels / 4; ++c)
          EXPECT_NEAR(rows.pixels[(16 * y + x) * channels + c], columns.pixels[(16 * x + y) * channels + c], 1e-6)
              << x << " " << y << " " << c;
  }
}

TEST(SensorDemosaic, ColoursDoNotMix) {
  for (int only = 0; only < 3; ++only) {
    const auto light = [&](int, int, int c) { return c == only ? Stokes{0.6, 0.2, -0.3} : Stokes{}; };
    expectStokes(noiseless(MosaicPattern::quadBayer), stokesImage(16, 16, light), 0);
  }
}

TEST(SensorDemosaic, WithoutCompensationTheLeakageRemains) {
  Sensor sensor = noiseless(MosaicPattern::mono);
  sensor.extinctionRatio = glm::dvec3(9);
  const image::Image image = stokesImage(8, 8, [](int, int, int) { return Stokes{0.5, 0.3, 0.4}; });
  const RawImage raw = expose(image, sensor, {});
  const auto dolp = [&](const Sensor& assumed) {
    const image::Image found = demosaic(raw, assumed, 0);
    return degreeOfLinearPolarization(static_cast<double>(found.pixels[1]), static_cast<double>(found.pixels[2]),
                                      static_cast<double>(found.pixels[3]));
  };
  Sensor ideal = sensor;
  ideal.extinctionRatio = glm::dvec3(1e9);
  EXPECT_NEAR(dolp(sensor), 1, 1e-3);
  EXPECT_NEAR(dolp(ideal), (1 - 1.0 / 9) / (1 + 1.0 / 9), 1e-3);
}

TEST(Sensor, PixelsFollowMalusLawWithLeakage) {
  // Fully polarized light at angle b behind a polarizer at angle a: T (cos^2(a - b) + sin^2(a - b) / X).
  const Sensor sensor = noiseless(MosaicPattern::quadBayer);
  for (const double b : {0.0, 20.0, 45.0, 77.0, 90.0, 135.0}) {
    const auto light = [&](int, int, int) {
      return Stokes{0.9, 0.9 * std::cos(2 * b * kPi / 180), 0.9 * std::sin(2 * b * kPi / 180)};
    };
    const RawImage raw = expose(stokesImage(4, 4, light), sensor, {});
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        constexpr double kDegrees[2][2] = {{90, 45}, {135, 0}};
        constexpr int kColours[2][2] = {{0, 1}, {1, 2}};
        const int colour = kColours[y / 2][x / 2];
        const double angle = (kDegrees[y % 2][x % 2] - b) * kPi / 180, c2 = std::pow(std::cos(angle), 2);
        const double electrons = 7e5 * sensor.response[colour] * 0.9 * sensor.transmission[colour] *
                                 (c2 + (1 - c2) / sensor.extinctionRatio[colour]);
        EXPECT_NEAR(raw.values[static_cast<std::size_t>(4 * y + x)], 100 + electrons / electronsPerNumber(sensor), 0.51)
            << b << " " << x << " " << y;
      }
  }
}

TEST(Sensor, ExposureIsThatOfTheMosaic) {
  Sensor sensor = noiseless(MosaicPattern::mono);
  sensor.electronsPerRadiance.reset();
  sensor.fullWell = 65535;
  sensor.blackLevel = 0;
  sensor.response = {0, 1, 0};
  sensor.transmission = glm::dvec3(1);
  sensor.extinctionRatio = glm::dvec3(std::numeric_limits<double>::infinity());
  for (const double ev : {-3.0, -1.0, 0.0, 1.0})
    EXPECT_EQ(expose(unpolarized(2, 2, 1), sensor, {.exposureEv = ev}).values.front(),
              std::min(65535L, std::lround(65535 * std::exp2(ev) / 2)))
        << ev;
}

TEST(Sensor, BlackLevelAndGainDefineTheNumbers) {
  for (const std::uint32_t bits : kSensorBits) {
    Sensor sensor = noiseless(MosaicPattern::mono);
    sensor.bits = bits;
    sensor.blackLevel = 17;
    EXPECT_EQ(expose(unpolarized(2, 2, 0), sensor, {}).values.front(), 17);
    EXPECT_EQ(expose(unpolarized(2, 2, 1e6), sensor, {}).values.front(), (1u << bits) - 1);
    sensor.gain = 1e4;  // the full well is 100 steps
    EXPECT_EQ(expose(unpolarized(2, 2, 1e6), sensor, {}).values.front(), 117);
    EXPECT_EQ(expose(unpolarized(2, 2, std::nan("")), sensor, {}).values.front(), 17);
    EXPECT_EQ(expose(unpolarized(2, 2, -1), sensor, {}).values.front(), 17);
  }
}

TEST(Sensor, ValuesDependOnSeedAndFrameOnly) {
  Sensor sensor = noiseless(MosaicPattern::quadBayer);
  sensor.shotNoise = true;
  sensor.readNoise = 30;
  sensor.fullWell = 1e5;
  sensor.electronsPerRadiance = 5e4;
  const auto light = [](int x, int y, int c) { return Stokes{0.2 + 0.01 * x, 0.01 * c, 0.002 * y}; };
  const image::Image image = stokesImage(64, 48, light);
  const auto exposeWith = [&](int threads, std::uint64_t seed, std::uint32_t frame) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
    return expose(image, sensor, {.seed = seed, .frame = frame}).values;
  };
  const auto first = exposeWith(1, 3, 0);
  EXPECT_EQ(first, exposeWith(2, 3, 0));
  EXPECT_NE(first, exposeWith(1, 4, 0));
  EXPECT_NE(first, exposeWith(1, 3, 1));
  EXPECT_NE(first, exposeWith(1, 3 + (std::uint64_t{1} << 40), 0));
  // A region has the values of the whole image.
  const image::Image part = stokesImage(8, 12, [&](int x, int y, int c) { return light(x + 20, y + 16, c); });
  const RawImage region = expose(part, sensor, {.seed = 3, .x = 20, .y = 16});
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(region.values[static_cast<std::size_t>(8 * y + x)],
                first[static_cast<std::size_t>(64 * (y + 16) + x + 20)]);
}

TEST(Sensor, RefusesSizesThatThePatternDoesNotFill) {
  EXPECT_THROW(expose(unpolarized(3, 2, 1), noiseless(MosaicPattern::mono), {}), Error);
  EXPECT_THROW(expose(unpolarized(6, 4, 1), noiseless(MosaicPattern::quadBayer), {}), Error);
  EXPECT_THROW(expose(unpolarized(4, 4, 1), noiseless(MosaicPattern::quadBayer), {.x = 2}), Error);
  EXPECT_NO_THROW(expose(unpolarized(6, 2, 1), noiseless(MosaicPattern::mono), {}));
  image::Image colour = unpolarized(4, 4, 1);
  colour.channels[0] = "R";
  EXPECT_THROW(expose(colour, noiseless(MosaicPattern::mono), {}), Error);
}

}  // namespace
}  // namespace malus::render
