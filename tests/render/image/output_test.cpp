#include "render/image/output.h"

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"

namespace malus::render {
namespace {

namespace fs = std::filesystem;

std::string readBytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

RenderResult stokesResult() {
  RenderResult result;
  result.width = 3;
  result.height = 2;
  result.channels = kStokesChannels;
  for (std::size_t i = 0; i < 6 * kStokesChannels; ++i) result.pixels.push_back(static_cast<float>(i) * 0.01f);
  result.device = "a device";
  return result;
}

pack::Pack somePack() {
  pack::Pack pack;
  pack.hash = 0x1234;
  pack.scene.name = "scene";
  pack.scene.origin = {10, 20, 30};
  return pack;
}

image::Image someImage() {
  return toImage(stokesResult(), somePack(), RenderParameters{3, 2, {0, 0, 3, 2}}, "embree", "stokes");
}

TEST(Output, ExrKeepsChannelsAndMetadata) {
  const fs::path path = fs::path(testing::TempDir()) / "output_test.exr";
  writeImage(path, someImage(), 0);
  const image::Image back = image::read(path);
  ASSERT_EQ(back.width, 3);
  ASSERT_EQ(back.height, 2);
  const image::Image sent = someImage();
  for (const char* name : {"R", "G", "B", "S0.R", "S1.G", "S3.B"}) {
    ASSERT_GE(back.channel(name), 0) << name;
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_EQ(back.pixels[i * back.channels.size() + static_cast<std::size_t>(back.channel(name))],
                sent.pixels[i * sent.channels.size() + static_cast<std::size_t>(sent.channel(name))])
          << name;
  }
  const auto attribute = [&](const std::string& name) -> std::string {
    for (const auto& [key, value] : back.attributes)
      if (key == name && std::holds_alternative<std::string>(value)) return std::get<std::string>(value);
    return "none";
  };
  EXPECT_EQ(attribute("malus:method"), "stokes");
  EXPECT_EQ(attribute("malus:renderer"), "embree");
  EXPECT_EQ(attribute("malus:pack"), "0000000000001234");
  EXPECT_EQ(attribute("malus:device"), "a device");
  EXPECT_EQ(attribute("DateTime"), "none");
}

TEST(Output, AlphaFollowsTheColours) {
  const image::Image image = someImage(), alpha = withAlpha(image, {0, 0.25, 0.5, 0.75, 1, 1});
  EXPECT_EQ(alpha.channels.size(), 16u);
  EXPECT_EQ(alpha.channel("A"), 3);
  EXPECT_EQ(alpha.channel("S0.R"), 4);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t c = 0; c < 16; ++c)
      EXPECT_EQ(alpha.pixels[16 * i + c], c < 3    ? image.pixels[15 * i + c]
                                          : c == 3 ? std::min(0.25f * static_cast<float>(i), 1.0f)
                                                   : image.pixels[15 * i + c - 1]);
  EXPECT_EQ(toneMapped(alpha, 0), toneMapped(image, 0));
}

TEST(Output, EqualImagesGiveEqualFiles) {
  const fs::path folder = testing::TempDir();
  for (const char* extension : {"exr", "png"}) {
    const fs::path a = folder / (std::string("equal_a.") + extension),
                   b = folder / (std::string("equal_b.") + extension);
    writeImage(a, someImage(), 1);
    writeImage(b, someImage(), 1);
    EXPECT_EQ(readBytes(a), readBytes(b)) << extension;
    EXPECT_FALSE(readBytes(a).empty());
  }
}

TEST(Output, ToneCurveIsMonotonicAndMeetsSrgb) {
  image::Image ramp;
  ramp.width = 1000;
  ramp.height = 1;
  ramp.channels = {"R", "G", "B"};
  for (int i = 0; i < 1000; ++i)
    for (int c = 0; c < 3; ++c) ramp.pixels.push_back(static_cast<float>(i) * 0.01f);
  const std::vector<std::uint8_t> bytes = toneMapped(ramp, 0);
  for (std::size_t i = 3; i < bytes.size(); ++i) EXPECT_GE(bytes[i], bytes[i - 3]);
  EXPECT_EQ(bytes.front(), 0);
  EXPECT_EQ(bytes.back(), 255);
  // IEC 61966-2-1: 0.5 is 188 of 255; one stop down it is 0.25, 137.
  EXPECT_EQ(bytes[3 * 50], 188);
  EXPECT_EQ(toneMapped(ramp, -1)[3 * 50], 137);
}

// Against the formula of output.h, at every exponent and at values that no image should have.
TEST(Output, ToneCurveIsThatOfTheHeader) {
  image::Image image;
  image.channels = {"R", "G", "B"};
  std::mt19937 random(19);
  for (int i = 0; i < 300000; ++i) image.pixels.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  std::uniform_real_distribution<float> uniform(0, 3);
  for (int i = 0; i < 300000; ++i) image.pixels.push_back(uniform(random));
  image.width = 200000;
  image.height = 1;
  for (const double exposureEv : {0.0, -1.3, 7.0, 100.0, -100.0}) {
    const std::vector<std::uint8_t> bytes = toneMapped(image, exposureEv);
    ASSERT_EQ(bytes.size(), image.pixels.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const float radiance = image.pixels[i];
      double x = std::isnan(radiance) || radiance < 0 ? 0 : static_cast<double>(radiance) * std::exp2(exposureEv);
      if (x > 0.7) x = 0.7 + 0.3 * (1 - std::exp(-(x - 0.7) / 0.3));
      const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
      ASSERT_EQ(bytes[i], std::lround(s * 255)) << radiance << " at " << exposureEv;
    }
  }
}

TEST(Output, RefusesOtherExtensions) {
  EXPECT_THROW(writeImage("image.jpg", someImage(), 0), Error);
  EXPECT_THROW(writeImage("image", someImage(), 0), Error);
}

TEST(Output, NoPartIsLeftWhereTheFolderIsMissing) {
  const fs::path folder = fs::path(testing::TempDir()) / "not-there";
  EXPECT_THROW(writeImage(folder / "a.exr", someImage(), 0), Error);
  EXPECT_FALSE(fs::exists(folder));
}

}  // namespace
}  // namespace malus::render
