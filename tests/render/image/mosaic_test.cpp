#include "render/image/mosaic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/image/polarization.h"
#include "render/sensor/mosaic_pattern.h"

namespace malus::render {
namespace {

namespace fs = std::filesystem;
constexpr double kPi = std::numbers::pi;

// Uniform light over the image: S0 of each colour, with one degree and angle of polarization.
image::Image patch(int width, int height, const std::array<double, 3>& s0, double dolp, double aolp) {
  image::Image image;
  image.width = width;
  image.height = height;
  image.channels = {"R", "G", "B"};
  for (const char* s : {"S0", "S1", "S2", "S3"})
    for (const char* c : {"R", "G", "B"}) image.channels.push_back(std::string(s) + "." + c);
  for (int i = 0; i < width * height; ++i) {
    image.pixels.insert(image.pixels.end(), {9, 9, 9});  // the colour behind some filter: not looked at
    for (const double factor : {1.0, dolp * std::cos(2 * aolp), dolp * std::sin(2 * aolp), 0.1})
      for (const double s : s0) image.pixels.push_back(static_cast<float>(factor * s));
  }
  return image;
}

TEST(Mosaic, LayoutIsThatOfPolarsensSensors) {
  // Light along one angle: its own pixel takes all of it, the crossed one nothing, the others half.
  const struct {
    double degrees;
    std::array<std::uint16_t, 4> values;  // upper left, upper right, lower left, lower right
  } cases[] = {{90, {255, 128, 128, 0}}, {45, {128, 255, 0, 128}}, {135, {128, 0, 255, 128}}, {0, {0, 128, 128, 255}}};
  for (const auto& c : cases) {
    const Mosaic m = mosaic(patch(4, 2, {1, 1, 1}, 1, c.degrees * kPi / 180), {});
    ASSERT_EQ(m.values.size(), 8u);
    for (const std::size_t left : {0u, 2u})
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(m.values[left + i % 2 + (i / 2) * 4], c.values[i], 1) << c.degrees << " " << i;
  }
  EXPECT_EQ(polarizerDegrees(0, 0), 90);
  EXPECT_EQ(polarizerDegrees(1, 0), 45);
  EXPECT_EQ(polarizerDegrees(0, 1), 135);
  EXPECT_EQ(polarizerDegrees(1, 1), 0);
  EXPECT_EQ(polarizerDegrees(6, 7), 135);
}

TEST(Mosaic, DemosaickedPatchGivesBackItsPolarization) {
  for (const unsigned bits : {8u, 12u, 16u})
    for (const double dolp : {0.0, 0.3, 0.8, 1.0})
      for (const double degrees : {0.0, 10.0, 45.0, 100.0, 170.0}) {
        const double aolp = degrees * kPi / 180, level = 0.8;
        const Mosaic m = mosaic(patch(2, 2, {level, level, level}, dolp, aolp), {bits, MosaicChannel::luminance, 0});
        const double i90 = m.values[0], i45 = m.values[1], i135 = m.values[2], i0 = m.values[3];
        // A step of 1 in one value turns S1, S2 by that step: half a step each way of two values.
        const double s0 = (i0 + i45 + i90 + i135) / 2, s1 = i0 - i90, s2 = i45 - i135, full = std::exp2(bits) - 1;
        SCOPED_TRACE(testing::Message() << bits << " bits, DoLP " << dolp << ", " << degrees << " degrees");
        EXPECT_NEAR(s0, level * full, 1);
        EXPECT_NEAR(s1, level * full * dolp * std::cos(2 * aolp), 1 + 1e-3);
        EXPECT_NEAR(s2, level * full * dolp * std::sin(2 * aolp), 1 + 1e-3);
        const double step = std::sqrt(2) / (level * full);
        EXPECT_NEAR(degreeOfLinearPolarization(s0, s1, s2), dolp, 2.5 * step);
        if (dolp > 0) {
          const double off = std::abs(angleOfLinearPolarization(s1, s2) - aolp);
          EXPECT_LT(std::min(off, kPi - off), step / dolp);
        }
      }
}

TEST(Mosaic, ScalesWithExposureAndStopsAtFullScale) {
  const auto first = [](double s0, unsigned bits, double exposureEv) {
    return mosaic(patch(2, 2, {s0, s0, s0}, 0, 0), {bits, MosaicChannel::luminance, exposureEv}).values.front();
  };
  EXPECT_EQ(first(1, 8, 0), 128);    // 127.5
  EXPECT_EQ(first(1, 8, -1), 64);    // 63.75
  EXPECT_EQ(first(1, 12, -2), 512);  // 511.875
  EXPECT_EQ(first(1, 16, 0), 32768);
  for (const unsigned bits : {8u, 12u, 16u}) {
    EXPECT_EQ(first(2, bits, 0), (1u << bits) - 1);
    EXPECT_EQ(first(1, bits, 30), (1u << bits) - 1);
    EXPECT_EQ(first(0, bits, 30), 0);
    EXPECT_EQ(first(-1, bits, 0), 0);
    EXPECT_EQ(first(std::nan(""), bits, 0), 0);
  }
}

TEST(Mosaic, SeesTheLuminanceOrOneColour) {
  const image::Image image = patch(2, 2, {0.2, 0.8, 0.4}, 0, 0);
  const auto first = [&](MosaicChannel channel) { return mosaic(image, {16, channel, 0}).values.front(); };
  EXPECT_EQ(first(MosaicChannel::red), std::lround(0.1 * 65535));
  EXPECT_EQ(first(MosaicChannel::green), std::lround(0.4 * 65535));
  EXPECT_EQ(first(MosaicChannel::blue), std::lround(0.2 * 65535));
  EXPECT_EQ(first(MosaicChannel::luminance), std::lround((0.2126 * 0.1 + 0.7152 * 0.4 + 0.0722 * 0.2) * 65535));
}

TEST(Mosaic, FilesHoldTheValues) {
  const fs::path folder = testing::TempDir();
  for (const unsigned bits : {8u, 12u, 16u})
    for (const char* extension : {"png", "tif", "tiff"}) {
      const Mosaic m = mosaic(patch(4, 2, {0.7, 0.7, 0.7}, 0.9, 0.4), {bits, MosaicChannel::luminance, 0});
      const fs::path path = folder / (std::string("mosaic_test.") + extension),
                     again = folder / ("again." + path.extension().string().substr(1));
      writeMosaic(path, m);
      const image::Image back = image::read(path);
      ASSERT_EQ(back.width, 4);
      ASSERT_EQ(back.height, 2);
      ASSERT_EQ(back.channels.size(), 1u);
      for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(std::lround(back.pixels[i] * (bits == 8 ? 255 : 65535)), m.values[i]) << bits << " " << extension;
      std::string description;
      for (const auto& [name, value] : back.attributes)
        if (name == "ImageDescription") description = std::get<std::string>(value);
      EXPECT_NE(description.find("90 45 / 135 0"), std::string::npos) << extension;
      writeMosaic(again, m);
      const auto readBytes = [](const fs::path& p) {
        std::ifstream file(p, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
      };
      EXPECT_EQ(readBytes(path), readBytes(again)) << "equal images give equal files";
      EXPECT_EQ(readBytes(path).find("DateTime"), std::string::npos);
      fs::remove(path);
      fs::remove(again);
    }
}

TEST(Mosaic, RefusesWhatItCannotMake) {
  const image::Image image = patch(2, 2, {1, 1, 1}, 0, 0);
  EXPECT_THROW(mosaic(image, {10, MosaicChannel::luminance, 0}), Error);
  EXPECT_THROW(mosaic(patch(3, 2, {1, 1, 1}, 0, 0), {}), Error);
  EXPECT_THROW(mosaic(patch(2, 1, {1, 1, 1}, 0, 0), {}), Error);
  image::Image colour = image;
  colour.channels = {"R", "G", "B"};
  EXPECT_THROW(mosaic(colour, {}), Error);
  EXPECT_THROW(writeMosaic("mosaic.jpg", mosaic(image, {})), Error);
  EXPECT_THROW(writeMosaic("mosaic", mosaic(image, {})), Error);
}

}  // namespace
}  // namespace malus::render
