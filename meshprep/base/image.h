// Pictures in memory and in files. Reading and writing go through OpenImageIO, which sits in a module of
// its own that is loaded at the first picture: it brings 260 libraries along, and `malus --help` needs none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace malus::image {

// Float picture, top row first, channels interleaved in the order of their names ("R", "S1.G").
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> pixels;
  // Metadata: names as in the file ("malus:method"), values text, number or numbers.
  using Value = std::variant<std::string, double, std::vector<float>>;
  std::vector<std::pair<std::string, Value>> attributes;

  int channel(std::string_view name) const;  // index, or -1
};

// Reads EXR, HDR, PNG, ... (whatever OpenImageIO reads); integers become 0 to 1. Throws Error.
Image read(const std::filesystem::path& path);

// Float EXR, ZIP compressed; equal pictures give equal files. Throws Error and leaves no part behind.
void writeExr(const std::filesystem::path& path, const Image& image);

// 8-bit RGB or grey PNG from width * height * channels bytes, sRGB encoded already.
void writePng(const std::filesystem::path& path, int width, int height, int channels,
              const std::vector<std::uint8_t>& pixels);

// Linear grey PNG or TIFF (uncompressed), by the extension: width * height values, top row first, in one
// sample of 8 bits (values up to 255) or 16 bits each, stored as they are. The description goes into the file.
enum class GreyDepth { bits8, bits16 };
void writeGrey(const std::filesystem::path& path, int width, int height, GreyDepth depth,
               const std::vector<std::uint16_t>& values, const std::string& description);

}  // namespace malus::image
