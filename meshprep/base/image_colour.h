// Linear colours of an image, by one rule for maps, environments and compare-images: the transfer function of
// Image::encoding is removed, and colours with other chromaticities than those of Rec. 709 (the ones that PNG files of
// malus are shown with) are converted to Rec. 709 under D65, by the matrices of SMPTE RP 177 and Bradford's adaptation.
// Alpha is not applied. Textures of glTF would be read by their role instead, as glTF requires.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::image {

class LinearColours {
 public:
  // Colours are the channels R, G and B, in any case of letters, or else one of grey: Y, or the first channel of an
  // image of one or two. image must outlive the object. usesAlpha: alpha is read elsewhere, which needs no note. Throws
  // Error(where): the image has neither, or its chromaticities do not span a plane.
  LinearColours(const Image& image, std::string_view where, bool usesAlpha = false);

  // Linear red, green and blue of pixel y * width + x. Values that are out of gamut after a conversion become 0.
  std::array<double, 3> at(std::size_t pixel) const;
  // The same channels without decoding and conversion, for numbers that are not colours.
  std::array<double, 3> stored(std::size_t pixel) const;

  bool isGrey() const { return channels_[0] == channels_[2]; }
  // Sentences for the user: metadata that is not applied, alpha that is left out, converted and clipped colours.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::array<double, 3> unclipped(std::size_t pixel) const;
  void findNotes(std::string_view where, bool usesAlpha);

  const Image& image_;
  std::array<std::size_t, 3> channels_{};
  bool isConverted_ = false;
  std::array<std::array<double, 3>, 3> toRec709_{};  // rows
  std::vector<std::string> notes_;
};

// Linear value of a number that is encoded by sRGB (IEC 61966-2-1).
double decodeSrgb(double encoded);

// Replaces the colours of an image by linear ones; images without colours are not changed. Returns the notes.
std::vector<std::string> makeLinear(Image& image, std::string_view where, bool usesAlpha = false);

}  // namespace malus::image
