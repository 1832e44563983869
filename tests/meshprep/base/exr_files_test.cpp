// EXR files of the image module: values, compression, damaged headers.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "tests/largest_memory.h"
#include "tests/meshprep/base/image_modules.h"

namespace malus::image::test {
namespace {

TEST_F(ImageModules, LosslessExrFilesKeepEveryValue) {
  const Image image = exampleImage();
  for (const ExrCompression compression : {ExrCompression::zip, ExrCompression::none}) {
    ASSERT_EQ(exrPng().writeExr(file("a.exr"), image, compression), "");
    const Image read = readBoth(file("a.exr"));
    EXPECT_EQ(malusAttributes(read).size(), 3u);
    ASSERT_EQ(read.channels.size(), image.channels.size());
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      const int at = read.channel(image.channels[c]);
      ASSERT_GE(at, 0) << image.channels[c];
      for (std::size_t i = 0; i < 37 * 23; ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(read.pixels[i * image.channels.size() + static_cast<std::size_t>(at)]),
                  std::bit_cast<std::uint32_t>(image.pixels[i * image.channels.size() + c]))
            << image.channels[c] << ", pixel " << i;
    }
  }
}

// Random bits, which are stored without compression, beside equal rows; and names of more than 31 letters.
TEST_F(ImageModules, ExrFilesOfNoiseAndOfConstantsKeepEveryValue) {
  Image image;
  image.width = 301;
  image.height = 100;
  image.channels = {"B", std::string(60, 'A'), "G", "R"};
  image.attributes = {{"malus:" + std::string(60, 'n'), std::string("text")}};
  std::mt19937 random(17);
  for (std::size_t i = 0; i < 4 * 301 * 100; ++i)
    image.pixels.push_back(i / (4 * 301) / 20 % 2 == 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(random()))
                                                       : 0.25f);
  ASSERT_EQ(exrPng().writeExr(file("a.exr"), image, ExrCompression::zip), "");
  const Image read = readBoth(file("a.exr"));
  EXPECT_EQ(malusAttributes(read).size(), 1u);
  ASSERT_EQ(read.channels.size(), 4u);
  const int red = read.channel("R"), green = read.channel("G");
  for (std::size_t i = 0; i < 301 * 100; ++i) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(read.pixels[4 * i + static_cast<std::size_t>(red)]),
              std::bit_cast<std::uint32_t>(image.pixels[4 * i + 3]));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(read.pixels[4 * i + static_cast<std::size_t>(green)]),
              std::bit_cast<std::uint32_t>(image.pixels[4 * i + 2]));
  }
  const auto size = fs::file_size(file("a.exr"));
  EXPECT_LT(size, image.pixels.size() * 4 * 7 / 10);
  EXPECT_GT(size, image.pixels.size() * 4 / 2);
}

// A smooth image of the channels that a render has.
TEST_F(ImageModules, DwaaExrFilesAreSmallAndClose) {
  Image image;
  image.width = image.height = 128;
  image.channels = {"R", "G", "B", "S1.R", "S1.G", "S1.B"};
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      for (int c = 0; c < 6; ++c)
        image.pixels.push_back(static_cast<float>(0.5 + 0.3 * std::sin(x / 20.0 + c) * std::cos(y / 15.0)) -
                               (c < 3 ? 0.0f : 0.4f));
  ASSERT_EQ(exrPng().writeExr(file("zip.exr"), image, ExrCompression::zip), "");
  ASSERT_EQ(exrPng().writeExr(file("dwaa.exr"), image, ExrCompression::dwaa), "");
  const Image exact = readBoth(file("zip.exr")), lossy = readBoth(file("dwaa.exr"));
  ASSERT_EQ(exact.channels, lossy.channels);
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) ASSERT_NEAR(exact.pixels[i], lossy.pixels[i], 0.02) << i;
  EXPECT_LT(fs::file_size(file("dwaa.exr")), fs::file_size(file("zip.exr")) / 4);
}

TEST_F(ImageModules, EqualImagesGiveIdenticalExrFilesWithAnyNumberOfThreads) {
  const auto bytes = [&](ExrCompression compression, int threads) {
    Image image;
    image.width = 64;
    image.height = 500;
    image.channels = {"R", "G", "S0.B"};
    std::mt19937 random(18);
    for (std::size_t i = 0; i < 3 * 64 * 500; ++i) image.pixels.push_back(static_cast<float>(random() % 1000) / 7);
    oneapi::tbb::task_arena(threads).execute(
        [&] { ASSERT_EQ(exrPng().writeExr(file("a.exr"), image, compression), ""); });
    std::ifstream stream(file("a.exr"), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(stream), {}};
  };
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  for (const ExrCompression compression : {ExrCompression::zip, ExrCompression::dwaa, ExrCompression::none}) {
    const std::string one = bytes(compression, 1);
    EXPECT_GT(one.size(), 1000u);
    EXPECT_EQ(one, bytes(compression, 1));
    EXPECT_EQ(one, bytes(compression, 4));
  }
}

// A header that declares more than the file has is an error, before that much memory is taken.
TEST_F(ImageModules, ExrHeadersThatDeclareMoreThanTheFileHasAreErrors) {
  ASSERT_EQ(exrPng().writeExr(file("a.exr"), exampleImage(), ExrCompression::zip), "");
  std::ifstream stream(file("a.exr"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::string huge("\xf0\xff\xff\x7f", 4), eight("\x08\0\0\0", 4);
  constexpr std::size_t kVersion = 4, kFirst = 8;
  const auto withAttribute = [&](const std::string& attribute) {
    return bytes.substr(0, kFirst) + attribute + bytes.substr(kFirst);
  };
  std::vector<std::string> files = {withAttribute(std::string("note\0string\0", 12) + huge),
                                    withAttribute(std::string("notes\0stringvector\0", 19) + eight + huge + "text"),
                                    withAttribute(std::string("note\0opaque\0", 12) + huge),
                                    withAttribute(std::string("list\0floatvector\0", 17) + huge)};
  files.push_back(files[0]);
  files.back()[kVersion + 1] = '\x10';  // several parts
  for (const std::string field : {"width", "height"}) {
    std::string window = bytes;
    const std::size_t at = window.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
    window.replace(at + (field == "width" ? 8 : 12), 4, huge);
    files.push_back(window);
  }
  const std::size_t before = malus::test::largestMemory();
  for (std::size_t i = 0; i < files.size(); ++i) {
    write("bad.exr", {files[i].begin(), files[i].end()});
    Image image;
    EXPECT_NE(exrPng().read(file("bad.exr"), image), "") << i;
  }
  EXPECT_LT(malus::test::largestMemory() - before, std::size_t{256} << 20u);
}

}  // namespace
}  // namespace malus::image::test
