// PNG files by libpng. Functions return an empty string, or the reason of their failure (image_module.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::image {

// First bytes of every PNG file.
bool isPng(const std::vector<unsigned char>& bytes);

// Decodes a file. Palettes are expanded, integers scaled to [0, 1]. The encoding is that of the first of the chunks
// sRGB, iCCP, and gAMA with cHRM that the file has; without them it is sRGB.
std::string decodePng(const std::vector<unsigned char>& bytes, Image& image);

enum class PngTransfer { sRgb, linear };
struct PngPixels {
  int width = 0, height = 0;
  int channels = 3;  // 1 or 3
  int bits = 8;      // 8 or 16
  PngTransfer transfer = PngTransfer::sRgb;
  std::string description;             // empty: none
  const std::uint8_t* data = nullptr;  // rows from the top; 16 bits in the byte order of the machine
};
std::string encodePng(const PngPixels& pixels, std::vector<unsigned char>& bytes);

}  // namespace malus::image
