// ICC profiles of image files: whether they describe sRGB.
#pragma once

#include <span>

namespace malus::image {

// Returns true if the profile describes sRGB: the curves of its red, green and blue (or of its grey) are those of
// sRGB within 0.005, and its colorants those of sRGB within 0.002. A profile without curves and colorants is compared
// by its description. Returns false for a damaged profile.
bool isSrgbProfile(std::span<const unsigned char> bytes);

// Note of an image with another profile (Encoding::notes).
inline constexpr const char* kForeignProfile =
    "has an ICC profile other than sRGB, which is not applied; convert the "
    "image to sRGB";

}  // namespace malus::image
