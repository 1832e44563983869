// The image modules: files that are written have the same values for both readers, of which that of the module of other
// formats is OpenImageIO. Windows, orientation and encodings of the files of other programs.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "meshprep/base/image_colour.h"
#include "tests/meshprep/base/image_modules.h"

namespace malus::image::test {
namespace {

TEST_F(ImageModules, PngFilesKeepEveryValue) {
  std::mt19937 random(15);
  for (const int channels : {1, 3}) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(31 * 17 * channels));
    for (std::uint8_t& p : pixels) p = static_cast<std::uint8_t>(random());
    std::vector<unsigned char> bytes;
    ASSERT_EQ(exrPng().encodePng(31, 17, channels, pixels.data(), bytes), "");
    write("a.png", bytes);
    const Image read = readBoth(file("a.png"));
    EXPECT_EQ(read.encoding.transfer, Encoding::Transfer::sRgb);
    ASSERT_EQ(read.pixels.size(), pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i)
      ASSERT_FLOAT_EQ(read.pixels[i], static_cast<float>(pixels[i]) / 255) << i;
  }
}

TEST_F(ImageModules, GreyFilesKeepEveryValue) {
  std::mt19937 random(16);
  for (const GreyDepth depth : {GreyDepth::bits8, GreyDepth::bits16}) {
    std::vector<std::uint16_t> values(29 * 11);
    for (std::uint16_t& v : values)
      v = static_cast<std::uint16_t>(random() % (depth == GreyDepth::bits8 ? 256 : 65536));
    const GreyPixels pixels{29, 11, depth, values.data(), "rows 90 45 / 135 0"};
    std::vector<unsigned char> bytes;
    ASSERT_EQ(exrPng().encodeGreyPng(pixels, bytes), "");
    write("a.png", bytes);
    ASSERT_EQ(formats().writeTiff(file("a.tif"), pixels), "");
    const Image png = readBoth(file("a.png"));
    Image tiff;
    ASSERT_EQ(formats().read(file("a.tif"), tiff), "");
    expectEqual(png, tiff, "PNG and TIFF");
    EXPECT_EQ(png.encoding.transfer, Encoding::Transfer::linear);
    for (const Image& image : {png, tiff}) {
      EXPECT_EQ(std::count_if(image.attributes.begin(), image.attributes.end(),
                              [](const auto& a) {
                                return a.first == "ImageDescription" &&
                                       std::get<std::string>(a.second) == "rows 90 45 / 135 0";
                              }),
                1);
      for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_FLOAT_EQ(image.pixels[i],
                        static_cast<float>(values[i]) / (depth == GreyDepth::bits8 ? 255.0f : 65535.0f));
    }
  }
}

// Files of other programs: every colour type and depth of PNG, half and integer channels and tiles of EXR. OpenImageIO
// reads the data window instead of the display window, and scales integers of EXR.
TEST_F(ImageModules, FilesOfOtherProgramsHaveTheSameValues) {
  std::size_t found = 0;
  for (const auto& entry : fs::directory_iterator(MALUS_IMAGE_FILES)) {
    ++found;
    const std::string name = entry.path().stem().string();
    if (name == "window" || name == "left-half" || name == "right-half" || name == "integers")
      readImage(entry.path().string());
    else
      readBoth(entry.path().string());
  }
  EXPECT_GE(found, 30u);
}

TEST_F(ImageModules, ColoursAreNotMultipliedByAlpha) {
  for (const auto& [name, red] : {std::pair("/rgba8.png", 130), std::pair("/rgba8-gamma.png", 195)}) {
    const Image image = readImage(std::string(MALUS_IMAGE_FILES) + name);
    ASSERT_EQ(image.channels.size(), 4u) << name;
    EXPECT_LT(image.pixels[3], 0.5f) << name;  // alpha
    EXPECT_NEAR(image.pixels[0], static_cast<float>(red) / 255, 1e-6f) << name;
  }
}

// Pixels that the data window does not store are 0; window.exr stores 13 x 7 of 20 x 20 from column -3, row 2 on.
TEST_F(ImageModules, DataWindowsArePlacedInTheDisplayWindow) {
  const Image image = readImage(std::string(MALUS_IMAGE_FILES) + "/window.exr");
  ASSERT_EQ(image.width, 20);
  ASSERT_EQ(image.height, 20);
  const auto alpha = [&](int x, int y) { return image.pixels[4 * static_cast<std::size_t>(20 * y + x) + 3]; };
  EXPECT_EQ(alpha(0, 1), 0);
  EXPECT_GT(alpha(0, 2), 0);
  EXPECT_GT(alpha(9, 8), 0);
  EXPECT_EQ(alpha(10, 8), 0);
  EXPECT_EQ(alpha(9, 9), 0);
}

// 8 x 4 pixels of which one file stores columns 0 to 3, the other columns 4 to 7, all 1.
TEST_F(ImageModules, DisjointDataWindowsDiffer) {
  const Image left = readImage(std::string(MALUS_IMAGE_FILES) + "/left-half.exr"),
              right = readImage(std::string(MALUS_IMAGE_FILES) + "/right-half.exr");
  ASSERT_EQ(left.width, 8);
  ASSERT_EQ(right.width, 8);
  ASSERT_EQ(left.pixels.size(), right.pixels.size());
  for (std::size_t i = 0; i < left.pixels.size(); ++i) {
    const bool isLeft = i / left.channels.size() % 8 < 4;
    EXPECT_EQ(left.pixels[i], isLeft ? 1 : 0) << i;
    EXPECT_EQ(right.pixels[i], isLeft ? 0 : 1) << i;
  }
}

using Transfer = Encoding::Transfer;

TEST_F(ImageModules, EncodingOfPngFilesIsThatOfTheirChunks) {
  const auto encoding = [](const char* name) { return readImage(std::string(MALUS_IMAGE_FILES) + name).encoding; };
  for (const char* name : {"/rgb8.png", "/grey16.png", "/grey8-srgb.png", "/icc-srgb.png", "/srgb-and-gamma.png"}) {
    EXPECT_EQ(encoding(name).transfer, Transfer::sRgb) << name;
    EXPECT_TRUE(encoding(name).notes.empty()) << name;
  }
  EXPECT_EQ(encoding("/icc-wide.png").notes.size(), 1u);
  EXPECT_EQ(encoding("/rgba8-linear.png").transfer, Transfer::linear);
  EXPECT_EQ(encoding("/grey8-linear.png").transfer, Transfer::linear);
  EXPECT_EQ(encoding("/rgb16-gamma.png").transfer, Transfer::power);
  EXPECT_NEAR(encoding("/rgb16-gamma.png").exponent, 2.2, 1e-4);
  const Encoding wide = encoding("/rec2020-linear.png");
  EXPECT_EQ(wide.transfer, Transfer::linear);
  ASSERT_TRUE(wide.chromaticities);
  EXPECT_NEAR((*wide.chromaticities)[0], 0.708, 1e-6);
  EXPECT_EQ(encoding("/layers.exr").transfer, Transfer::linear);
}

// A PNG with the chunk cICP in front of its data.
std::vector<unsigned char> withCodePoints(const std::string& path, unsigned char primaries, unsigned char transfer) {
  std::ifstream stream(path, std::ios::binary);
  std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), {}};
  // Length, name, content and checksum, which is not checked for chunks that libpng does not know.
  const std::vector<unsigned char> chunk = {0, 0, 0, 4, 'c', 'I', 'C', 'P', primaries, transfer, 0, 1, 0, 0, 0, 0};
  bytes.insert(bytes.begin() + 8 + 25, chunk.begin(), chunk.end());  // behind signature and header
  return bytes;
}

TEST_F(ImageModules, CodePointsOfPngFilesPrecedeOtherChunks) {
  const struct {
    unsigned char primaries, transfer;
    Transfer expected;
    bool isWide;
    std::size_t notes;
  } kCases[] = {{1, 8, Transfer::linear, false, 0}, {1, 13, Transfer::sRgb, false, 0},
                {9, 8, Transfer::linear, true, 0},  {12, 13, Transfer::sRgb, true, 0},
                {9, 16, Transfer::sRgb, true, 1},   {5, 18, Transfer::sRgb, false, 2}};
  for (const char* name : {"/rgb8.png", "/rgb16-gamma.png", "/icc-wide.png"})
    for (const auto& c : kCases) {
      write("points.png", withCodePoints(std::string(MALUS_IMAGE_FILES) + name, c.primaries, c.transfer));
      const Encoding encoding = readImage(file("points.png")).encoding;
      EXPECT_EQ(encoding.transfer, c.expected) << name << " " << int{c.transfer};
      EXPECT_EQ(encoding.chromaticities.has_value(), c.isWide) << name << " " << int{c.primaries};
      EXPECT_EQ(encoding.notes.size(), c.notes) << name;
    }
}

// integers.exr: 3 x 2 pixels; R counts from 0, G is 1, B counts from 70000, id is 2^24.
TEST_F(ImageModules, IntegersOfExrFilesKeepTheirValue) {
  const Image image = readImage(std::string(MALUS_IMAGE_FILES) + "/integers.exr");
  ASSERT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B", "id"}));
  for (std::size_t i = 0; i < 6; ++i) {
    const auto count = static_cast<float>(i);
    const std::vector<float> expected = {count, 1, 70000 + count, 16777216};
    EXPECT_EQ(std::vector<float>(image.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i),
                                 image.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i + 4)),
              expected);
  }
}

TEST_F(ImageModules, InterlacedPalettesAreExpanded) {
  const Image image = readImage(std::string(MALUS_IMAGE_FILES) + "/palette-interlaced.png");
  ASSERT_EQ(image.channels.size(), 4u);
  EXPECT_NEAR(LinearColours(image, "").at(3)[1], 0.502886, 1e-5);
  EXPECT_EQ(LinearColours(image, "").at(4)[1], 0);
  EXPECT_EQ(LinearColours(image, "").notes().size(), 1u);
}

// The same grey in every format, in integers of 8 and 16 bits and with both kinds of alpha.
TEST_F(ImageModules, IntegersOfEveryFormatAreSrgb) {
  std::size_t found = 0;
  for (const auto& entry : fs::directory_iterator(MALUS_OTHER_IMAGES)) {
    ++found;
    Image image;
    ASSERT_EQ(formats().read(entry.path().string(), image), "") << entry.path();
    const LinearColours colours(image, "");
    EXPECT_NEAR(colours.at(5)[1], 0.502886, 1e-4) << entry.path();
    EXPECT_EQ(colours.notes().size(), entry.path().string().find("associated") == std::string::npos ? 0u : 1u);
  }
  EXPECT_EQ(found, 8u);
}

// An image of 3 x 2 distinct pixels, stored along each pair of axes.
TEST_F(ImageModules, AxesAndExposureOfRadianceFiles) {
  constexpr int kWidth = 3, kHeight = 2;
  const auto value = [](int x, int y) { return 10 + 40 * x + 100 * y; };
  for (const std::string first : {"-Y", "+Y", "-X", "+X"})
    for (const std::string sign : {"-", "+"}) {
      const bool rowsAreY = first[1] == 'Y';
      const std::string second = sign + (rowsAreY ? "X" : "Y");
      const int rows = rowsAreY ? kHeight : kWidth, columns = rowsAreY ? kWidth : kHeight;
      std::string text = "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\nEXPOSURE= 0.25\nCOLORCORR=1 2 4\n\n" + first +
                         " " + std::to_string(rows) + " " + second + " " + std::to_string(columns) + "\n";
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
          const int x = rowsAreY ? c : r, y = rowsAreY ? r : c;
          const std::string &xAxis = rowsAreY ? second : first, &yAxis = rowsAreY ? first : second;
          const int v = value(xAxis[0] == '+' ? x : kWidth - 1 - x, yAxis[0] == '-' ? y : kHeight - 1 - y);
          text += {static_cast<char>(v), static_cast<char>(v), static_cast<char>(v), static_cast<char>(136)};
        }
      write("sky.hdr", {text.begin(), text.end()});
      Image image;
      ASSERT_EQ(formats().read(file("sky.hdr"), image), "") << first << second;
      ASSERT_EQ(image.width, kWidth) << first << second;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          for (int c = 0; c < 3; ++c)  // exposure 0.5
            EXPECT_FLOAT_EQ(image.pixels[3 * static_cast<std::size_t>(kWidth * y + x) + static_cast<std::size_t>(c)],
                            static_cast<float>(value(x, y)) * 2 / static_cast<float>(1 << c))
                << first << second << " " << x << " " << y;
    }
  for (const char* line :
       {"EXPOSURE=0", "EXPOSURE=-1", "COLORCORR=1 0 1", "EXPOSURE=nan", "EXPOSURE=two", "EXPOSURE=", "COLORCORR=1 2"}) {
    const std::string text = std::string("#?RADIANCE\n") + line + "\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\1\1\1\200";
    write("bad.hdr", {text.begin(), text.end()});
    Image image;
    EXPECT_NE(formats().read(file("bad.hdr"), image).find("EXPOSURE"), std::string::npos) << line;
  }
}

TEST_F(ImageModules, GammaOfRadianceFilesIsNoted) {
  const auto read = [&](const std::string& line, Image& image) {
    const std::string text = "#?RADIANCE\n" + line + "\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\100\100\100\200";
    write("gamma.hdr", {text.begin(), text.end()});
    return formats().read(file("gamma.hdr"), image);
  };
  for (const char* line : {"GAMMA=2.2", "GAMMA= 0.4545", "GAMMA=two"}) {
    Image image;
    ASSERT_EQ(read(line, image), "") << line;
    ASSERT_EQ(image.encoding.notes.size(), 1u) << line;
    EXPECT_NE(image.encoding.notes[0].find(line), std::string::npos) << image.encoding.notes[0];
    EXPECT_EQ(image.pixels[0], 0.25f) << line;
  }
  for (const char* line : {"GAMMA=1", "GAMMA= 1.0", "SOFTWARE=GAMMA=2"}) {
    Image image;
    ASSERT_EQ(read(line, image), "") << line;
    EXPECT_TRUE(image.encoding.notes.empty()) << line;
  }
}

TEST_F(ImageModules, XyzeFilesAreRefusedByName) {
  for (const char* line : {"FORMAT=32-bit_rle_xyze", "FORMAT= 32-bit_rle_xyze ", "FORMAT=32-bit_rle_xyze\r"}) {
    const std::string text = std::string("#?RADIANCE\n") + line + "\n\n-Y 1 +X 1\n\100\100\100\200";
    write("xyz.hdr", {text.begin(), text.end()});
    Image image;
    const std::string message = formats().read(file("xyz.hdr"), image);
    for (const char* part : {"xyze", "32-bit_rle_rgbe", "ra_xyze"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST_F(ImageModules, FilesWithoutTheBytesOfAFormatAreErrors) {
  Image image;
  write("sky.hdr", {'#', '?', 'R', 'A', 'D', 'I', 'A', 'N', 'C', 'E', '\n'});
  EXPECT_NE(exrPng().read(file("sky.hdr"), image), "");
  EXPECT_NE(formats().read(file("sky.hdr"), image), "");
  write("empty.png", {});
  EXPECT_NE(exrPng().read(file("empty.png"), image), "");
}

TEST_F(ImageModules, DamagedFilesAreErrors) {
  ASSERT_EQ(exrPng().writeExr(file("a.exr"), exampleImage(), ExrCompression::zip), "");
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
  EXPECT_NE(exrPng().writeExr("/nowhere/a.exr", exampleImage(), ExrCompression::zip), "");
}

}  // namespace
}  // namespace malus::image::test
