// The image module of the bundle against the one with OpenImageIO: each reads the files of both with the same bits.
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "meshprep/base/image_module.h"

namespace malus::image {
namespace {

namespace fs = std::filesystem;

const Module& load(const char* file) {
  void* library = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(::dlerror());
  return *reinterpret_cast<const Module* (*)()>(::dlsym(library, kModuleEntry))();
}
const Module& oiio() {
  static const Module& kModule = load(MALUS_OIIO_MODULE);
  return kModule;
}
const Module& exrPng() {
  static const Module& kModule = load(MALUS_EXR_PNG_MODULE);
  return kModule;
}

class ImageModules : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("malus-modules-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::vector<unsigned char>& bytes) const {
    std::ofstream(file(name), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  fs::path folder_;
};

std::map<std::string, Image::Value> malusAttributes(const Image& image) {
  std::map<std::string, Image::Value> result;
  for (const auto& [name, value] : image.attributes)
    if (name.starts_with("malus:")) result.emplace(name, value);
  return result;
}

// NaN equals NaN of the same bits.
void expectEqual(const Image& a, const Image& b, const std::string& what) {
  EXPECT_EQ(a.width, b.width) << what;
  EXPECT_EQ(a.height, b.height) << what;
  EXPECT_EQ(a.channels, b.channels) << what;
  EXPECT_EQ(malusAttributes(a), malusAttributes(b)) << what;
  ASSERT_EQ(a.pixels.size(), b.pixels.size()) << what;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.pixels[i]), std::bit_cast<std::uint32_t>(b.pixels[i]))
        << what << ", value " << i << ": " << a.pixels[i] << " and " << b.pixels[i];
}

Image readBoth(const std::string& path) {
  Image a, b;
  EXPECT_EQ(oiio().read(path, a), "") << path;
  EXPECT_EQ(exrPng().read(path, b), "") << path;
  expectEqual(a, b, path);
  return b;
}

// Colours, Stokes channels and odd names; every class of floating-point value.
Image exampleImage() {
  Image image;
  image.width = 37;
  image.height = 23;
  image.channels = {"R", "G", "B", "S0.R", "S0.G", "S0.B", "S3.B", "Z", "A", "depth.Z", "zeta"};
  std::mt19937 random(14);
  const float special[] = {0.0f,
                           -0.0f,
                           std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::denorm_min(),
                           std::numeric_limits<float>::max()};
  const std::size_t count = image.channels.size() * 37 * 23;
  std::uniform_real_distribution<float> uniform(-4, 4);
  for (std::size_t i = 0; i < count; ++i)
    image.pixels.push_back(i % 7 == 0 ? special[i / 7 % std::size(special)] : std::exp2(4 * uniform(random)));
  image.attributes = {{"malus:scene", std::string("glass \"wall\"")},
                      {"malus:depth", 6.0},
                      {"malus:third", 1.0 / 3},
                      {"worldToCamera", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}}};
  return image;
}

TEST_F(ImageModules, ExrFilesHaveTheSameValues) {
  const Image image = exampleImage();
  ASSERT_EQ(oiio().writeExr(file("a.exr"), image), "");
  ASSERT_EQ(exrPng().writeExr(file("b.exr"), image), "");
  const Image a = readBoth(file("a.exr")), b = readBoth(file("b.exr"));
  expectEqual(a, b, "written by both");
  EXPECT_EQ(malusAttributes(a).size(), 3u);
  for (const std::string& name : image.channels) EXPECT_GE(b.channel(name), 0) << name;
  const int zeta = b.channel("zeta");
  ASSERT_GE(zeta, 0);
  for (std::size_t i = 0; i < 37 * 23; ++i)  // written and read without a change
    ASSERT_EQ(std::bit_cast<std::uint32_t>(b.pixels[i * b.channels.size() + static_cast<std::size_t>(zeta)]),
              std::bit_cast<std::uint32_t>(image.pixels[(i + 1) * image.channels.size() - 1]));
}

TEST_F(ImageModules, EqualImagesGiveIdenticalExrFiles) {
  ASSERT_EQ(exrPng().writeExr(file("a.exr"), exampleImage()), "");
  ASSERT_EQ(exrPng().writeExr(file("b.exr"), exampleImage()), "");
  const auto bytes = [&](const char* name) {
    std::ifstream stream(file(name), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(stream), {}};
  };
  EXPECT_EQ(bytes("a.exr"), bytes("b.exr"));
  EXPECT_GT(bytes("a.exr").size(), 1000u);
}

TEST_F(ImageModules, PngFilesHaveTheSameValues) {
  std::mt19937 random(15);
  for (const int channels : {1, 3}) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(31 * 17 * channels));
    for (std::uint8_t& p : pixels) p = static_cast<std::uint8_t>(random());
    std::vector<unsigned char> a, b;
    ASSERT_EQ(oiio().encodePng(31, 17, channels, pixels.data(), a), "");
    ASSERT_EQ(exrPng().encodePng(31, 17, channels, pixels.data(), b), "");
    write("a.png", a);
    write("b.png", b);
    expectEqual(readBoth(file("a.png")), readBoth(file("b.png")), std::to_string(channels) + " channels");
  }
}

TEST_F(ImageModules, GreyPngFilesHaveTheSameValues) {
  std::mt19937 random(16);
  for (const GreyDepth depth : {GreyDepth::bits8, GreyDepth::bits16}) {
    std::vector<std::uint16_t> values(29 * 11);
    for (std::uint16_t& v : values)
      v = static_cast<std::uint16_t>(random() % (depth == GreyDepth::bits8 ? 256 : 65536));
    ASSERT_EQ(oiio().writeGrey(file("a.png"), 29, 11, depth, values.data(), "rows 90 45 / 135 0"), "");
    ASSERT_EQ(exrPng().writeGrey(file("b.png"), 29, 11, depth, values.data(), "rows 90 45 / 135 0"), "");
    const Image a = readBoth(file("a.png")), b = readBoth(file("b.png"));
    expectEqual(a, b, "grey");
    EXPECT_FLOAT_EQ(b.pixels[5], static_cast<float>(values[5]) / (depth == GreyDepth::bits8 ? 255.0f : 65535.0f));
  }
}

// Files of other programs: every colour type and depth of PNG, half and integer channels and tiles of EXR.
TEST_F(ImageModules, FilesOfOtherProgramsHaveTheSameValues) {
  std::size_t found = 0;
  for (const auto& entry : fs::directory_iterator(MALUS_IMAGE_FILES)) {
    ++found;
    readBoth(entry.path().string());
  }
  EXPECT_GE(found, 22u);
}

TEST_F(ImageModules, ColoursAreNotMultipliedByAlpha) {
  for (const auto& [name, red] : {std::pair("/rgba8.png", 130), std::pair("/rgba8-gamma.png", 195)}) {
    const Image image = readBoth(std::string(MALUS_IMAGE_FILES) + name);
    ASSERT_EQ(image.channels.size(), 4u) << name;
    EXPECT_LT(image.pixels[3], 0.5f) << name;  // alpha
    EXPECT_NEAR(image.pixels[0], static_cast<float>(red) / 255, 1e-6f) << name;
  }
}

TEST_F(ImageModules, OtherFormatsAreErrorsThatNameTheSupportedOnes) {
  Image image;
  write("sky.hdr", {'#', '?', 'R', 'A', 'D', 'I', 'A', 'N', 'C', 'E', '\n'});
  const std::string message = exrPng().read(file("sky.hdr"), image);
  EXPECT_NE(message.find("EXR and PNG"), std::string::npos) << message;
  const std::uint16_t value = 1;
  EXPECT_NE(exrPng().writeGrey(file("a.tif"), 1, 1, GreyDepth::bits16, &value, "").find("PNG"), std::string::npos);
}

TEST_F(ImageModules, DamagedFilesAreErrors) {
  ASSERT_EQ(exrPng().writeExr(file("a.exr"), exampleImage()), "");
  std::vector<unsigned char> png;
  const std::vector<std::uint8_t> pixels(3 * 64 * 64, 7);
  ASSERT_EQ(exrPng().encodePng(64, 64, 3, pixels.data(), png), "");
  write("a.png", png);
  for (const char* name : {"a.exr", "a.png"}) {
    const auto size = fs::file_size(file(name));
    for (const auto kept : {size - 40, size / 2, std::uintmax_t{40}, std::uintmax_t{9}}) {
      fs::resize_file(file(name), kept);
      Image image;
      EXPECT_NE(exrPng().read(file(name), image), "") << name << ", " << kept << " bytes";
    }
  }
  Image image;
  EXPECT_NE(exrPng().read(file("missing.exr"), image), "");
  EXPECT_NE(exrPng().writeExr("/nowhere/a.exr", exampleImage()), "");
}

// A header of a few bytes that declares more pixels than memory.
TEST_F(ImageModules, SizesAboveTheLimitAreErrors) {
  std::vector<unsigned char> png;
  const std::vector<std::uint8_t> row(3 * 70000, 7);
  ASSERT_EQ(exrPng().encodePng(70000, 1, 3, row.data(), png), "");
  write("wide.png", png);
  Image image;
  EXPECT_NE(exrPng().read(file("wide.png"), image), "");
  Image wide;
  wide.width = 70000;
  wide.height = 1;
  wide.channels = {"R"};
  wide.pixels.resize(70000);
  ASSERT_EQ(exrPng().writeExr(file("wide.exr"), wide), "");
  const std::string message = exrPng().read(file("wide.exr"), image);
  EXPECT_NE(message.find("70000"), std::string::npos) << message;
}

}  // namespace
}  // namespace malus::image
