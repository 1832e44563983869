// Parameters of present.comp: push constants, in one layout for C++ and GLSL. At most 128 bytes, which every device
// has. Pixels are read by their addresses, because a storage buffer is limited to 128 MiB on some devices, which an
// image with Stokes vectors of more than 2.2 million pixels exceeds.
#ifdef __cplusplus
#pragma once

#include <cstdint>

#include <glm/vec4.hpp>

namespace malus::gpu {
using uint = std::uint32_t;
using vec4 = glm::vec4;
using FloatBuffer = std::uint64_t;  // VkDeviceAddress
#endif

const uint kDisplayAgainstOther = 1u;  // flags: difference between the sides, not to the reference
const uint kDisplayHasFlip = 2u;

struct DisplayImage {
  FloatBuffer pixels;
  uint size;  // width, and height times 65536
  uint rows;  // upper rows that are rendered, and channels times 65536; no rows: no image
};

struct DisplayParameters {
  vec4 analyser;           // as render::Analyser
  DisplayImage coarse[2];  // of each side, complete, stretched to the window
  DisplayImage fine[2];    // of each side, in front of it
  FloatBuffer reference;   // of the size of the window
  FloatBuffer flipValues;  // of the size of the window, of each side
  uint referenceRows;      // upper rows that are rendered
  float divider;           // column of the split [pixels]; the width of the window without a split
  float gain;              // 2^exposure
  float differenceScale;   // difference of the last colour
  uint target;             // width of the window, and its height times 65536
  uint flags;
};

#ifdef __cplusplus
static_assert(sizeof(DisplayParameters) <= 128);
}  // namespace malus::gpu
#endif
