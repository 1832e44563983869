// What the OpenImageIO module offers to its loader (image.cpp). Exceptions do not cross: each function
// returns an empty text, or what went wrong.
#pragma once

#include <cstdint>
#include <string>

#include "bake/image/image.h"

namespace malus::image {

struct Module {
  std::string (*read)(const std::string& path, Image& image);
  std::string (*writeExr)(const std::string& path, const Image& image);
  std::string (*writePng)(const std::string& path, int width, int height, int channels, const std::uint8_t* pixels);
};

inline constexpr const char* kModuleEntry = "malusImageModule";  // const Module* malusImageModule()

}  // namespace malus::image
