// What the OpenImageIO module offers to its loader (image.cpp). Exceptions do not cross: each function
// returns an empty text, or what went wrong.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::image {

struct Module {
  std::string (*read)(const std::string& path, Image& image);
  std::string (*writeExr)(const std::string& path, const Image& image);
  // To memory: OpenImageIO's PNG files are cut short in silence where the disk is full.
  std::string (*encodePng)(int width, int height, int channels, const std::uint8_t* pixels,
                           std::vector<unsigned char>& bytes);
  std::string (*writeGrey)(const std::string& path, int width, int height, GreyDepth depth, const std::uint16_t* values,
                           const std::string& description);
};

inline constexpr const char* kModuleEntry = "malusImageModule";  // const Module* malusImageModule()

}  // namespace malus::image
