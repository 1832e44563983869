// What a renderer returns: the region's pixels, top row first, and what it cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace malus::render {

// Per pixel 3 floats (the colour behind the filter), or 15: the colour, then S0, S1, S2, S3, each r g b, of
// the light before the filter, in the camera's frame of the pixel's ray.
inline constexpr std::size_t kColourChannels = 3;
inline constexpr std::size_t kStokesChannels = 15;

struct Cost {
  double buildMs = 0;      // acceleration structure, shaders, uploads
  double traceMs = 0;      // rays and shading alone (on a GPU by its own clock)
  double wallMs = 0;       // tracing as the caller sees it, read-back included
  std::uint64_t rays = 0;  // camera, specular and shadow rays; 0 where they were not counted
};

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::size_t channels = kColourChannels;
  std::vector<float> pixels;
  Cost cost;
  std::string device;
};

}  // namespace malus::render
