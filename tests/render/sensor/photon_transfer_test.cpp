// Noise of the sensor against the photon transfer theory: the exact distribution of the numbers, which is a Poisson
// distribution clipped at the full well, convolved with the read noise and quantized, and the linear camera model of
// EMVA 1288, variance = (readNoise^2 + mean charge) / gain^2 + 1/12.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/sensor/expose.h"
#include "render/sensor/philox.h"
#include "tests/render/sensor/stokes_image.h"

namespace malus::render {
namespace {

constexpr int kSide = 384;
constexpr double kPixels = static_cast<double>(kSide) * kSide;
// Standard errors that a statistic may deviate; by chance once in 150 000 statistics of a normal distribution.
constexpr double kMostErrors = 4.5;

Sensor noisySensor() {
  Sensor sensor;
  sensor.response = {1, 0, 0};
  sensor.fullWell = 11000;
  sensor.readNoise = 3;
  sensor.bits = 12;
  sensor.blackLevel = 50;
  sensor.gain = 2.75;
  sensor.electronsPerRadiance = 1000;
  return sensor;
}

double normalCdf(double x) { return std::erfc(-x / std::sqrt(2)) / 2; }

// Probability of each number of a pixel with a mean charge.
std::vector<double> distribution(const Sensor& sensor, double mean) {
  const double largest = largestNumber(sensor), gain = *sensor.gain;
  std::vector<double> numbers(static_cast<std::size_t>(largest) + 1);
  double remaining = 1;
  const auto addCharge = [&](double charge, double probability) {
    const double spread = 10 * sensor.readNoise / gain + 2, center = sensor.blackLevel + charge / gain;
    const double first = std::clamp(std::floor(center - spread), 0.0, largest),
                 last = std::clamp(std::ceil(center + spread), 0.0, largest);
    for (double k = first; k <= last; ++k) {
      const auto below = [&](double edge) {
        const double x = (edge - sensor.blackLevel) * gain - charge;
        return sensor.readNoise > 0 ? normalCdf(x / sensor.readNoise) : x >= 0 ? 1.0 : 0.0;
      };
      const double low = k == 0 ? 0 : below(k - 0.5), high = k == largest ? 1 : below(k + 0.5);
      numbers[static_cast<std::size_t>(k)] += probability * (high - low);
    }
  };
  const double from = std::max(0.0, std::floor(mean - 12 * std::sqrt(mean) - 20)),
               to = std::min(sensor.fullWell - 1, std::ceil(mean + 12 * std::sqrt(mean) + 20));
  for (double n = from; n <= to; ++n) {
    const double p = mean == 0 ? (n == 0 ? 1 : 0) : std::exp(n * std::log(mean) - mean - std::lgamma(n + 1));
    addCharge(n, p);
    remaining -= p;
  }
  if (to == sensor.fullWell - 1) addCharge(sensor.fullWell, std::max(0.0, remaining));
  return numbers;
}

struct Moments {
  double mean = 0, variance = 0, fourth = 0;  // central
};
Moments moments(const std::vector<double>& weights) {
  Moments m;
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k], m.mean += weights[k] * static_cast<double>(k);
  m.mean /= sum;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double d = static_cast<double>(k) - m.mean;
    m.variance += weights[k] * d * d / sum, m.fourth += weights[k] * d * d * d * d / sum;
  }
  return m;
}

std::vector<double> histogram(const Sensor& sensor, const RawImage& raw) {
  std::vector<double> counts(static_cast<std::size_t>(largestNumber(sensor)) + 1);
  for (const std::uint16_t value : raw.values) ++counts[value];
  return counts;
}

// Pearson's statistic with numbers joined until 10 are expected, as standard deviations from its mean.
double chiSquareErrors(const std::vector<double>& counts, const std::vector<double>& probabilities) {
  double statistic = 0, expected = 0, found = 0;
  int bins = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    expected += kPixels * probabilities[k], found += counts[k];
    if (expected < 10 && k + 1 < counts.size()) continue;
    if (expected > 0) statistic += (found - expected) * (found - expected) / expected, ++bins;
    expected = found = 0;
  }
  const int freedom = std::max(1, bins - 1);
  return (statistic - freedom) / std::sqrt(2.0 * freedom);
}

RawImage exposeMean(const Sensor& sensor, double mean, std::uint32_t frame = 0) {
  // An ideal polarizer passes half of unpolarized light.
  return expose(unpolarized(kSide, kSide, 2 * (mean - sensor.darkSignal) / *sensor.electronsPerRadiance), sensor,
                {.seed = 7, .frame = frame});
}

// From darkness to beyond the full well.
constexpr double kMeans[] = {0, 0.5, 5, 11, 13, 100, 1000, 5000, 9000, 10900, 11000, 11100, 20000};

TEST(PhotonTransfer, NumbersHaveTheExactDistribution) {
  for (const double mean : kMeans)
    for (const double readNoise : {0.0, 3.0, 20.0}) {
      Sensor sensor = noisySensor();
      sensor.readNoise = readNoise;
      if (mean == 20000) sensor.gain = 2.5;  // the converter saturates before the pixel
      const RawImage raw = exposeMean(sensor, mean);
      const std::vector<double> counts = histogram(sensor, raw), expected = distribution(sensor, mean);
      const Moments found = moments(counts), truth = moments(expected);
      SCOPED_TRACE(testing::Message() << "mean " << mean << " e-, read noise " << readNoise << " e-");
      EXPECT_NEAR(found.mean, truth.mean, kMostErrors * std::sqrt(truth.variance / kPixels) + 1e-9);
      EXPECT_NEAR(found.variance, truth.variance,
                  kMostErrors * std::sqrt((truth.fourth - truth.variance * truth.variance) / kPixels) + 1e-9);
      EXPECT_LT(chiSquareErrors(counts, expected), kMostErrors);
    }
}

TEST(PhotonTransfer, FollowsTheLinearCameraModel) {
  // Levels that neither 0 nor the full well clips.
  for (const double mean : {100.0, 1000.0, 5000.0, 9000.0})
    for (const double gain : {2.75, 5.0, 12.0}) {
      Sensor sensor = noisySensor();
      sensor.gain = gain;
      sensor.readNoise = 10;
      const Moments found = moments(histogram(sensor, exposeMean(sensor, mean)));
      const double variance = (100 + mean) / (gain * gain) + 1.0 / 12;
      SCOPED_TRACE(testing::Message() << "mean " << mean << " e-, gain " << gain);
      EXPECT_NEAR(found.mean, sensor.blackLevel + mean / gain, kMostErrors * std::sqrt(variance / kPixels));
      EXPECT_NEAR(found.variance / variance, 1, kMostErrors * std::sqrt(2 / kPixels));
    }
}

TEST(PhotonTransfer, DarkSignalHasShotNoise) {
  Sensor sensor = noisySensor();
  sensor.darkSignal = 400;
  const Moments found = moments(histogram(sensor, exposeMean(sensor, 400)));
  const double variance = (400 + 9) / (2.75 * 2.75) + 1.0 / 12;
  EXPECT_NEAR(found.mean, 50 + 400 / 2.75, kMostErrors * std::sqrt(variance / kPixels));
  EXPECT_NEAR(found.variance / variance, 1, kMostErrors * std::sqrt(2 / kPixels));
}

TEST(PhotonTransfer, SaturationMaskCountsFullWells) {
  for (const double mean : {10000.0, 10900.0, 11000.0, 11100.0, 12000.0}) {
    Sensor sensor = noisySensor();
    const RawImage raw = exposeMean(sensor, mean);
    const double found = static_cast<double>(std::count(raw.saturation.begin(), raw.saturation.end(), 255)) / kPixels;
    double expected = 1;  // probability of a charge of at least the full well
    for (double n = std::floor(mean - 2000); n < sensor.fullWell; ++n)
      expected -= std::exp(n * std::log(mean) - mean - std::lgamma(n + 1));
    expected = std::max(0.0, expected);
    EXPECT_NEAR(found, expected, kMostErrors * std::sqrt(expected * (1 - expected) / kPixels) + 1e-6) << mean;
  }
  // The largest number saturates too, below the full well.
  Sensor sensor = noisySensor();
  sensor.gain = 1;
  const RawImage raw = exposeMean(sensor, 8000);
  EXPECT_EQ(std::count(raw.saturation.begin(), raw.saturation.end(), 255), kSide * kSide);
  EXPECT_EQ(std::count(raw.values.begin(), raw.values.end(), 4095), kSide * kSide);
}

// Correlation of two images of noise, in standard errors.
double correlationErrors(const RawImage& a, const RawImage& b, std::size_t shift) {
  const Sensor sensor = noisySensor();
  const Moments m = moments(histogram(sensor, a));
  double sum = 0;
  for (std::size_t i = 0; i + shift < a.values.size(); ++i)
    sum += (a.values[i] - m.mean) * (b.values[i + shift] - m.mean);
  return sum / (m.variance * std::sqrt(kPixels));
}

TEST(PhotonTransfer, NoiseOfPixelsAndFramesIsIndependent) {
  const RawImage first = exposeMean(noisySensor(), 1000, 0), second = exposeMean(noisySensor(), 1000, 1);
  EXPECT_GT(correlationErrors(first, first, 0), 100);
  EXPECT_LT(std::abs(correlationErrors(first, second, 0)), kMostErrors);
  for (const std::size_t shift : {1, 2, kSide, kSide + 1})
    EXPECT_LT(std::abs(correlationErrors(first, first, shift)), kMostErrors) << shift;
}

TEST(Philox, KnownAnswers) {
  // Test vectors of Random123 (kat_vectors: philox4x32, 10 rounds).
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}), (Block{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(philox({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
            (Block{0xd16cfe09u, 0x94fdcceb, 0x5001e420u, 0x24126ea1u}));
}

}  // namespace
}  // namespace malus::render
