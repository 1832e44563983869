// ICC profiles of image files: whether they describe sRGB.
#pragma once

#include <span>

namespace malus::image {

// Returns true if the profile describes sRGB: the curves of its red, green and blue (or of its grey) are those of
// sRGB within 0.5 %, and its colorants those of sRGB within 0.002 (ICC.1:2010, sections 7, 9 and 10). A profile
// without curves and colorants is compared by its description.
bool isSrgbProfile(std::span<const unsigned char> profile);

// Note of an image with another profile (Encoding::notes).
inline constexpr const char* kForeignProfile =
    "has an ICC profile other than sRGB, which is not applied; convert the "
    "image to sRGB";

}  // namespace malus::image
