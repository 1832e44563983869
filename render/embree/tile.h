// Rendering of one tile by one method. Each build of a method is a separate translation unit (method_tracer.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/embree/embree.h"
#include "render/embree/ray_log.h"
#include "render/scene/fault.h"
#include "shaders/gpu/scene.h"

namespace malus::embree {

struct TileInput {
  const Bvh* bvh;
  const render::RenderScene* scene;
  const gpu::CameraParameters* camera;
  std::uint32_t beginX, beginY, endX, endY;  // pixels within the region
  float* pixels;                             // of the whole region, top row first
  bool stokes;                               // iterative methods: render Stokes vectors by four analysers
  std::uint32_t effects;                     // bits of shaders::Effect that the image needs
  RayLog* log = nullptr;                     // takes the rays; of renderTileChecked only
};

struct TileOutput {
  std::uint64_t rays = 0;
  render::Faults faults;  // of renderTileChecked only
};

struct Method {
  const char* name;
  const char* build;
  std::uint32_t effects;  // bits of shaders::Effect that are compiled in
  TileOutput (*renderTile)(const TileInput&);
  TileOutput (*renderTileChecked)(const TileInput&);  // with --check-numerics; null in some builds
};

}  // namespace malus::embree
