// Parameters of present.comp: push constants, in one layout for C++ and GLSL. At most 128 bytes, which every device
// has.
#ifdef __cplusplus
#pragma once

#include <cstdint>

#include <glm/vec4.hpp>

namespace malus::gpu {
using uint = std::uint32_t;
using vec4 = glm::vec4;
#endif

// An image in one of the buffers.
struct DisplayImage {
  uint width;
  uint height;
  uint channels;
  uint rows;  // upper rows that are rendered; 0: no image
};

struct DisplayParameters {
  vec4 analyser;           // as render::Analyser
  DisplayImage coarse[2];  // of each side, complete, stretched to the window
  DisplayImage fine[2];    // of each side, in front of it
  uint referenceRows;      // of the size of the window
  uint againstOther;       // 1: difference between the sides; 0: difference to the reference
  float divider;           // column of the split [pixels]; the width of the window without a split
  float gain;              // 2^exposure
  float differenceScale;   // difference of the last colour
  uint target;             // width of the window, and its height times 65536
};

#ifdef __cplusplus
static_assert(sizeof(DisplayParameters) <= 128);
}  // namespace malus::gpu
#endif
