// Degree and angle of linear polarization of a rendered picture, as numbers (EXR) and as colours (PNG).
//
// All functions take an image with channels S0.R ... S2.B in the camera's frame of each pixel's ray
// (render/image/output.h), of the light before any filter, and throw Error where a channel is missing.
// DoLP = sqrt(S1^2 + S2^2) / S0 is between 0 and 1: rounding above 1 is cut off, and it is 0 where S0 is not
// positive. AoLP = mod(atan2(S2, S1) / 2, pi) is in radians, at least 0 and below pi, counter-clockwise from
// the picture's x; 0 where S1 = S2 = 0, and of no meaning where DoLP is of the size of rounding.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::render {

double degreeOfLinearPolarization(double s0, double s1, double s2);
double angleOfLinearPolarization(double s1, double s2);

// S0, S1, S2 of the luminance: the colours weighted by .2126, .7152, .0722 (ITU-R BT.709). A weighted sum of
// Stokes vectors is one, so this is what a camera without colours sees. Pixel by pixel.
std::vector<std::array<double, 3>> luminanceStokes(const image::Image& picture);
// The same of one colour, 0 to 2 for R, G, B.
std::vector<std::array<double, 3>> colourStokes(const image::Image& picture, int colour);

// Channels DoLP.R, DoLP.G, DoLP.B or AoLP.R, ...: each colour by itself, with the attributes of the picture.
image::Image dolpChannels(const image::Image& picture);
image::Image aolpChannels(const image::Image& picture);

// sRGB bytes for the eye, of the luminance.
// DoLP from 0 to 1 in the colours of viridis (S. van der Walt and N. Smith, matplotlib 1.5, CC0).
std::array<std::uint8_t, 3> dolpColour(double dolp);
std::vector<std::uint8_t> dolpColours(const image::Image& picture);
// AoLP from 0 to pi once round the hues of one lightness and chroma in Oklab (B. Ottosson, A perceptual color
// space for image processing, 2020), so that 0 and pi are one colour: 0 is red, 45 degrees yellow-green, 90
// cyan, 135 violet. Below a DoLP of kAolpFadeDolp it fades to black, where the angle says little.
inline constexpr double kAolpFadeDolp = 0.05;
std::array<std::uint8_t, 3> aolpColour(double aolp, double dolp);
std::vector<std::uint8_t> aolpColours(const image::Image& picture);

// By the extension of path: .exr (channels) or .png (colours). Throws Error for another.
void writeDolp(const std::filesystem::path& path, const image::Image& picture);
void writeAolp(const std::filesystem::path& path, const image::Image& picture);

}  // namespace malus::render
