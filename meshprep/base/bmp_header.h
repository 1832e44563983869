// Check of the header of a BMP file. OpenImageIO allocates and decodes run-length encoded pixels when it opens the
// file, before its caller knows the size. Source: Microsoft, "Bitmap Storage".
#pragma once

#include <cstdint>
#include <string_view>

namespace malus::image {

// Returns false if the file is a BMP file of a larger size than an image may have (image_module.h). start: its first
// bytes.
bool isSupportedBmp(std::string_view start, std::uint64_t fileBytes);

}  // namespace malus::image
