// Header of a Radiance file (.hdr). Source: G. W. Larson and R. Shakespeare, Rendering with Radiance, 1998, and
// filefmts.pdf of https://radsite.lbl.gov/radiance
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace malus::image {

struct RadianceHeader {
  // Products of all EXPOSURE and COLORCORR lines. Radiance is the stored value divided by both.
  double exposure = 1;
  std::array<double, 3> colourCorrection{1, 1, 1};
  std::optional<std::array<double, 8>> primaries;  // x and y of red, green, blue and white
  std::string format;                              // "32-bit_rle_rgbe", "32-bit_rle_xyze"; empty: not stated
  std::string gamma;                               // of GAMMA, which the format does not define; empty: none
  int rows = 0, columns = 0;                       // scanlines and pixels of each, as stored
  int orientation = 1;                             // of the stored rows, as in orientation.h
};

// text: the beginning of the file. Nothing: no resolution line, or an exposure that is not positive and finite.
std::optional<RadianceHeader> readRadianceHeader(std::string_view text);

}  // namespace malus::image
