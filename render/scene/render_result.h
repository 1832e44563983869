// The result of a render: the pixels of the region, top row first, and their cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/scene/embree_path.h"
#include "render/scene/fault.h"
#include "render/scene/vulkan_path.h"
#include "shaders/gpu/constants.h"

namespace malus::render {

// Floats per pixel, in the order that shaders/gpu/constants.h states. The Stokes vector is that of the light before the
// filter, in the camera frame of the pixel's ray.
inline constexpr std::size_t kColourChannels = gpu::kColourChannels;
inline constexpr std::size_t kStokesChannels = gpu::kStokesChannels;

struct Cost {
  double buildMs = 0;          // acceleration structure
  double uploadMs = 0;         // upload of the scene to the device
  double compileMs = 0;        // shaders and pipeline, if this render used them first
  double traceMs = 0;          // rays and shading alone; on a GPU by its own clock
  double readBackMs = 0;       // copy of the image from the device
  double wallMs = 0;           // tracing and read-back by the clock of the caller
  std::uint64_t launches = 0;  // submissions to the device; 0: it has none
  std::uint64_t rays = 0;      // camera, specular and shadow rays; 0 if not counted
};

struct RenderResult {
  std::uint32_t width = 0, height = 0;
  std::size_t channels = kColourChannels;
  std::vector<float> pixels;
  Cost cost;
  Faults faults;  // if RenderParameters::checkNumerics is set
  std::string device;
  VulkanPath vulkanPath = VulkanPath::automatic;  // the path taken; automatic: not by the Vulkan renderer
  EmbreePath embreePath = EmbreePath::automatic;  // the same of the Embree renderer
  std::string withoutRecursion;  // reason if a stack replaced the recursion of a recursive method; else empty
};

}  // namespace malus::render
