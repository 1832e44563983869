// Degree and angle of linear polarization (DoLP, AoLP) of a rendered image, as numbers (EXR) and as colours (PNG).
//
// The functions take an image with channels S0.R ... S2.B in the camera frame of each pixel's ray
// (render/image/output.h), of the light before any filter, and throw Error if a channel is missing.
// DoLP = sqrt(S1^2 + S2^2) / S0, clamped to [0, 1]; 0 if S0 is not positive.
// AoLP = mod(atan2(S2, S1) / 2, pi) in radians, in [0, pi), counter-clockwise from the x axis of the image; 0 if
// S1 = S2 = 0, and meaningless if DoLP is of the size of rounding errors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::render {

double degreeOfLinearPolarization(double s0, double s1, double s2);
double angleOfLinearPolarization(double s1, double s2);

// Weights of R, G, B in the luminance (ITU-R BT.709).
inline constexpr std::array<double, 3> kLuminanceWeights = {0.2126, 0.7152, 0.0722};

// Reads the Stokes vectors of single pixels. Throws Error if a channel is missing. The image must outlive it.
class StokesChannels {
 public:
  explicit StokesChannels(const image::Image& image);
  // S0, S1, S2 of a pixel, the weighted sum of its colours; a colour of weight 0 is not read.
  std::array<double, 3> weighted(std::size_t pixel, const std::array<double, 3>& weights) const;

 private:
  const image::Image& image_;
  std::array<std::array<std::size_t, 3>, 3> index_{};  // [component][colour]
};

// S0, S1, S2 of the luminance of each pixel: the colours weighted by .2126, .7152, .0722 (ITU-R BT.709). A weighted sum
// of Stokes vectors is a Stokes vector: that of a monochrome camera.
std::vector<std::array<double, 3>> luminanceStokes(const image::Image& image);
// The same for one colour; 0, 1, 2 for R, G, B.
std::vector<std::array<double, 3>> colourStokes(const image::Image& image, int colour);

// Channels DoLP.R, DoLP.G, DoLP.B or AoLP.R, ..., one per colour, with the attributes of the image.
image::Image dolpChannels(const image::Image& image);
image::Image aolpChannels(const image::Image& image);

// sRGB bytes for display, of the luminance.
// DoLP from 0 to 1 in the colours of viridis (S. van der Walt and N. Smith, matplotlib 1.5, CC0).
std::array<std::uint8_t, 3> dolpColour(double dolp);
std::vector<std::uint8_t> dolpColours(const image::Image& image);
// AoLP from 0 to pi as the hue at constant lightness and chroma in Oklab (B. Ottosson, A perceptual color space for
// image processing, 2020), so that 0 and pi have the same colour: 0 is red, 45 degrees yellow-green, 90 cyan, 135
// violet. Fades to black below a DoLP of kAolpFadeDolp, where the angle carries little information.
inline constexpr double kAolpFadeDolp = 0.05;
std::array<std::uint8_t, 3> aolpColour(double aolp, double dolp);
std::vector<std::uint8_t> aolpColours(const image::Image& image);

// Writes .exr (channels) or .png (colours) by the extension of path. Throws Error for another extension.
void writeDolp(const std::filesystem::path& path, const image::Image& image,
               image::ExrCompression compression = image::ExrCompression::zip);
void writeAolp(const std::filesystem::path& path, const image::Image& image,
               image::ExrCompression compression = image::ExrCompression::zip);

}  // namespace malus::render
