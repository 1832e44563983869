// EXR files by OpenEXR. Functions return an empty string, or the reason of their failure (image_module.h).
#pragma once

#include <string>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::image {

// First bytes of every EXR file.
bool isExr(const std::vector<unsigned char>& bytes);

// Decodes the first part of a file, its display window. Channels are ordered by layer, and within a layer R, G, B, A, Z
// before others.
std::string decodeExr(const std::vector<unsigned char>& bytes, Image& image);

// Writes as image::writeExr describes, into the existing file.
std::string writeExrFile(const std::string& path, const Image& image, ExrCompression compression);

}  // namespace malus::image
