// Interface between an image module and its loader (image.cpp). Exceptions must not cross it: each function returns an
// empty string, or the reason of its failure. Parameters as in image.h.
//
// There are two modules: oiio_module.cpp reads every format of OpenImageIO; exr_png_module.cpp, for the bundle, EXR and
// PNG only. Both read EXR and PNG by the same functions. The loader uses the file malus-image.so.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::image {

// Limits that image.h documents: a header of a few bytes can declare any size. No codec stores more values per byte of
// a file: Zstandard stores 131072 equal bytes in 4, deflate 1032 in 1, each with up to 8 pixels of 1 bit.
inline constexpr int kMaxSide = 65536;
inline constexpr int kMaxChannels = 64;
inline constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 30;  // 4 GiB
inline constexpr std::uint64_t kMaxValuesPerByte = 32768;

inline std::uint64_t mostValues(std::uint64_t fileBytes) { return std::min(kMaxValues, fileBytes * kMaxValuesPerByte); }

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
