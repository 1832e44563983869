// One method's rendering of a tile; each build of a method is a translation unit of its own (method_tracer.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/embree/embree.h"
#include "render/scene/fault.h"
#include "shaders/gpu/scene.h"

namespace malus::embree {

struct TileInput {
  const Bvh* bvh;
  const render::RenderScene* scene;
  const gpu::CameraParameters* camera;
  std::uint32_t beginX, beginY, endX, endY;  // within the region
  float* pixels;                             // the region's
  bool stokes;                               // of a loop: Stokes vectors by four analysers
};

struct TileOutput {
  std::uint64_t rays = 0;
  render::Faults faults;  // of the checking variant
};

struct Method {
  const char* name;
  const char* build;
  std::uint32_t effects;  // bits of shaders::Effect that are compiled in
  TileOutput (*renderTile)(const TileInput&);
  TileOutput (*renderTileChecked)(const TileInput&);  // with --check-numerics; not every build has it
};

}  // namespace malus::embree
