// Interfaces between the image modules and their loader (image.cpp). Exceptions must not cross them: each function
// returns an empty string, or the reason of its failure. Parameters as in image.h.
//
// malus-image.so (exr_png_module.cpp) reads and writes EXR and PNG. malus-image-formats.so (formats_module.cpp) reads
// the other formats of OpenImageIO and writes TIFF; the bundle does not have it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::image {

// A grey image of writeGrey: width * height values.
struct GreyPixels {
  int width = 0, height = 0;
  GreyDepth depth = GreyDepth::bits16;
  const std::uint16_t* values = nullptr;
  const char* description = "";
};

// Whether a file with these 8 first bytes is read by Module; FormatsModule never gets one.
inline bool startsAsExrOrPng(std::string_view start) {
  using std::string_view_literals::operator""sv;
  return start.starts_with("v/1\1"sv) || start == "\x89PNG\r\n\x1a\n"sv;
}

struct Module {
  std::string (*read)(const std::string& path, Image& image);
  // Into the existing file.
  std::string (*writeExr)(const std::string& path, const Image& image, ExrCompression compression);
  // Encode to memory.
  std::string (*encodePng)(int width, int height, int channels, const std::uint8_t* pixels,
                           std::vector<unsigned char>& bytes);
  std::string (*encodeGreyPng)(const GreyPixels& pixels, std::vector<unsigned char>& bytes);
};
struct FormatsModule {
  std::string (*read)(const std::string& path, Image& image);
  std::string (*writeTiff)(const std::string& path, const GreyPixels& pixels);
};

// Name of the only symbol of malus-image.so: extern "C" const Module* malusImageModule(). Never null, valid until exit.
inline constexpr const char* kModuleEntry = "malusImageModule";
// The same of malus-image-formats.so: extern "C" const FormatsModule* malusFormatsModule().
inline constexpr const char* kFormatsModuleEntry = "malusFormatsModule";

}  // namespace malus::image
