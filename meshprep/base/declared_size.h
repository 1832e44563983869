// Sizes that files declare in formats which OpenImageIO decodes when it opens them, before its caller knows the size:
// BMP, GIF, WebP, JPEG, JPEG 2000 and HEIF.
#pragma once

#include <iosfwd>
#include <optional>

#include "meshprep/base/image_size.h"

namespace malus::image {

// Returns the size of the image in pixels with the channels that OpenImageIO gives it; of several images the one with
// the most pixels. Nothing: another format, or a header that ends early. file: open in binary mode; its position
// changes.
//
// Sources: Microsoft, "Bitmap Storage"; CompuServe, "GIF 89a", section 18; Google, "WebP Container Specification"; RFC
// 6386, section 9.1, and RFC 9649, section 3.4 (WebP); ITU-T T.81, annex B (JPEG); ITU-T T.800, annexes A.5.1 and I
// (JPEG 2000); ISO/IEC 23008-12, section 6.5.3 (HEIF).
std::optional<ImageSize> declaredSize(std::istream& file);

}  // namespace malus::image
