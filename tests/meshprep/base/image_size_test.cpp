// Files that declare more pixels than an image may have: each is refused by its header, without memory for the pixels.
#include "meshprep/base/image_size.h"

#include <algorithm>
#include <array>

#include "tests/largest_memory.h"
#include "tests/meshprep/base/image_modules.h"

namespace malus::image::test {
namespace {

constexpr unsigned kSide = 60000;

std::string big(std::uint64_t value, std::size_t count) {
  std::string bytes;
  for (std::size_t i = count; i-- > 0;) bytes += static_cast<char>(value >> (8 * i) & 0xffu);
  return bytes;
}
std::string little(std::uint64_t value, std::size_t count) {
  const std::string bytes = big(value, count);
  return {bytes.rbegin(), bytes.rend()};
}
std::string zeros(std::size_t count) { return std::string(count, '\0'); }

// Box of ISO/IEC 14496-12, also with a size of 64 bits.
std::string box(const std::string& type, const std::string& content, bool isLarge = false) {
  return isLarge ? big(1, 4) + type + big(content.size() + 16, 8) + content
                 : big(content.size() + 8, 4) + type + content;
}

std::string bmp(const std::string& size) {
  return "BM" + little(78, 4) + zeros(4) + little(54, 4) + little(40, 4) + size + little(1, 2) + little(8, 2) +
         little(1, 4) + zeros(60);
}

// Segments of tables, text and garbage before the frame.
std::string jpeg(const std::string& marker) {
  const std::string text(65000, 'x');
  std::string bytes = "\xff\xd8";
  for (int i = 0; i < 3; ++i) bytes += "\xff\xe1" + big(text.size() + 2, 2) + text;
  return bytes + "garbage\xff\xff\xff\xc4" + big(3, 2) + "x" + marker + big(17, 2) + "\x08" + big(kSide, 2) +
         big(kSide, 2) + "\x03" + "\1\x11" + zeros(1) + "\2\x11" + zeros(1) + "\3\x11" + zeros(1) + zeros(100);
}

std::string codestream(unsigned offset) {
  return std::string("\xff\x4f\xff\x51") + big(47, 2) + big(0, 2) + big(kSide + offset, 4) + big(kSide + offset, 4) +
         big(offset, 4) + big(offset, 4) + big(64, 4) + big(64, 4) + big(0, 8) + big(3, 2) + zeros(100);
}

std::string jpeg2000() {
  return big(12, 4) + "jP  \r\n\x87\n" + box("ftyp", "jp2 " + big(0, 4) + "jp2 ") +
         box("jp2h", box("ihdr", big(4, 4) + big(4, 4) + big(3, 2) + zeros(4))) + box("jp2c", codestream(7));
}

std::string heif(bool isLarge) {
  const auto property = [](unsigned side) { return box("ispe", zeros(4) + big(side, 4) + big(side, 4)); };
  const std::string properties = box("ipco", property(8) + property(kSide) + box("pixi", zeros(8)) + property(16));
  return box("ftyp", "mif1" + big(0, 4) + "mif1heic") + box("mdat", zeros(90'000), isLarge) +
         box("meta", zeros(4) + box("hdlr", zeros(25)) + box("iprp", properties, isLarge), isLarge);
}

// Little-endian, with one strip or one tile.
std::string tiff(unsigned side, unsigned tile) {
  std::vector<std::array<unsigned, 3>> entries = {{256, 4, side}, {257, 4, side}, {258, 3, 8},
                                                  {259, 3, 1},    {262, 3, 1},    {277, 3, 1}};
  if (tile > 0)
    entries.insert(entries.end(), {{322, 4, tile}, {323, 4, tile}, {324, 4, 8}, {325, 4, 64}});
  else
    entries.insert(entries.end(), {{273, 4, 8}, {278, 4, side}, {279, 4, 64}});
  std::sort(entries.begin(), entries.end());
  std::string bytes = "II" + little(42, 2) + little(72, 4) + zeros(64) + little(entries.size(), 2);
  for (const auto& [tag, type, value] : entries)
    bytes += little(tag, 2) + little(type, 2) + little(1, 4) + little(value, 4);
  return bytes + little(0, 4);
}

std::string png() {
  std::vector<unsigned char> bytes;
  const std::uint8_t pixel[3] = {1, 2, 3};
  EXPECT_EQ(exrPng().encodePng(1, 1, 3, pixel, bytes), "");
  std::string text(bytes.begin(), bytes.end());
  text.replace(16, 8, big(kSide, 4) + big(kSide, 4));
  // The checksum of the header: CRC-32 of ISO 3309.
  std::uint32_t sum = 0xffffffffu;
  for (std::size_t i = 12; i < 29; ++i) {
    sum ^= static_cast<unsigned char>(text[i]);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1u ^ ((sum & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return text.replace(29, 4, big(~sum, 4));
}

using ImageSizes = ImageModules;

TEST_F(ImageSizes, LargeSizesAreRefusedByTheHeader) {
  const std::string side = std::to_string(kSide);
  const std::string wide = little(kSide, 4), down = little(std::uint32_t(-60000), 4);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"wide.bmp", bmp(wide + wide)},
      {"down.bmp", bmp(wide + down)},
      {"core.bmp", "BM" + zeros(12) + little(12, 4) + little(kSide, 2) + little(kSide, 2) + zeros(60)},
      {"a.webp", "RIFF" + little(22, 4) + "WEBPVP8X" + little(10, 4) + little(0, 4) + little(kSide - 1, 3) +
                     little(kSide - 1, 3) + zeros(60)},
      {"a.gif", "GIF89a" + little(kSide, 2) + little(kSide, 2) + zeros(60)},
      {"baseline.jpg", jpeg("\xff\xc0")},
      {"progressive.jpg", jpeg("\xff\xc2")},
      {"arithmetic.jpg", jpeg("\xff\xca")},
      {"a.jp2", jpeg2000()},
      {"a.j2k", codestream(0)},
      {"a.heic", heif(false)},
      {"large.avif", heif(true)},
      {"a.tga", zeros(2) + "\2" + zeros(9) + little(kSide, 2) + little(kSide, 2) + "\x18" + zeros(60)},
      {"a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + side + " +X " + side + "\n" + zeros(60)},
      {"a.ppm", "P6\n" + side + " " + side + "\n255\n" + zeros(60)},
      {"a.tif", tiff(kSide, 0)},
      {"tiled.tif", tiff(kSide, 64)},
      {"tile.tif", tiff(16, kSide)},
      {"a.png", png()},
  };
  const std::size_t before = malus::test::largestMemory();
  for (const auto& [name, bytes] : files) {
    write(name, {bytes.begin(), bytes.end()});
    Image image;
    const std::string message = (name == "a.png" ? exrPng().read : formats().read)(file(name), image);
    EXPECT_NE(message.find("unsupported size " + side + " x " + side), std::string::npos) << name << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << name;
    EXPECT_TRUE(image.pixels.empty()) << name;
  }
  EXPECT_LT(malus::test::largestMemory() - before, std::size_t{256} << 20u);
}

// OpenImageIO reads both: it decodes thumbnails when it opens a PSD file, and makes up an image for the name *.null.
TEST_F(ImageSizes, FormatsWithoutACheckedHeaderAreRefused) {
  const std::string psd =
      "8BPS" + big(1, 2) + zeros(6) + big(3, 2) + big(1, 4) + big(1, 4) + big(8, 2) + big(3, 2) + zeros(14) + "\1\2\3";
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>("a.psd", psd), {"a.png", psd}, {"a.null", ""}}) {
    write(name, {bytes.begin(), bytes.end()});
    Image image;
    const std::string message = formats().read(file(name), image);
    EXPECT_NE(message.find("unknown format; expected PNG"), std::string::npos) << name << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << name;
  }
}

TEST_F(ImageSizes, SidesAboveTheLimitAreErrors) {
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
  ASSERT_EQ(exrPng().writeExr(file("wide.exr"), wide, ExrCompression::zip), "");
  const std::string message = exrPng().read(file("wide.exr"), image);
  EXPECT_NE(message.find("70000"), std::string::npos) << message;
}

TEST_F(ImageSizes, LargeImagesThatTheFileHasAreRead) {
  const std::string grey = "P5\n4000 3000\n255\n" + std::string(12'000'000, '\x80');
  write("large.pgm", {grey.begin(), grey.end()});
  Image image;
  EXPECT_EQ(formats().read(file("large.pgm"), image), "");
  EXPECT_EQ(image.pixels.size(), 12'000'000u);
}

}  // namespace
}  // namespace malus::image::test
