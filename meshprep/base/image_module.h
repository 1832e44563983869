// Interface between the OpenImageIO module (oiio_module.cpp) and its loader (image.cpp). Exceptions must not cross it:
// each function returns an empty string, or the reason of its failure. Parameters as in image.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::image {

struct Module {
  std::string (*read)(const std::string& path, Image& image);
  std::string (*writeExr)(const std::string& path, const Image& image);
  // Encodes to memory: OpenImageIO does not report a full disk when it writes PNG files.
  std::string (*encodePng)(int width, int height, int channels, const std::uint8_t* pixels,
                           std::vector<unsigned char>& bytes);
  std::string (*writeGrey)(const std::string& path, int width, int height, GreyDepth depth, const std::uint16_t* values,
                           const std::string& description);
};

// Name of the module's only symbol: extern "C" const Module* malusImageModule(). Never null, valid until exit.
inline constexpr const char* kModuleEntry = "malusImageModule";

}  // namespace malus::image
