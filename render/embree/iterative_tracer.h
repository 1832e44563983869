// Tracer of one iterative method. A generated file per build of a method defines MALUS_METHOD, the method's struct, and
// every MALUS_EFFECT_ macro as 1 or 0, and includes this once.
#include "bake/pack/format.h"
#include "render/embree/scene_access.h"

#include "shaders/optics/language_begin.h"
#undef FN
#define FN  // members

namespace malus::f32 {
namespace {

using namespace malus::gpu;

template <bool kCheckNumerics>
struct Tracer : MALUS_METHOD, embree::SceneAccess {
  using SceneAccess::SceneAccess;
  static constexpr int kPathStackSize = pack::kMaxDepth + (MALUS_EFFECT_ROUGHNESS ? static_cast<int>(kFacets) : 0);

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/iterative/camera_path.h"
#pragma GCC diagnostic pop

#include "render/embree/find_hit.h"
};

template <bool kCheckNumerics>
embree::TileOutput renderTile(const embree::TileInput& tile) {
  if (tile.stokes)
    return embree::renderPixels<Tracer<kCheckNumerics>>(tile, kStokesChannels, [](auto& tracer, float* out) {
      const Stokes s = tracer.cameraPathStokes(tracer.pixelX, tracer.pixelY);
      const real3 values[5] = {tracer.cameraColour(s), s.s0, s.s1, s.s2, s.s3};
      for (std::size_t i = 0; i < kStokesChannels; ++i) out[i] = values[i / 3][static_cast<int>(i % 3)];
    });
  return embree::renderPixels<Tracer<kCheckNumerics>>(tile, kColourChannels, [](auto& tracer, float* out) {
    const real3 colour = tracer.cameraPathColour(tracer.pixelX, tracer.pixelY);
    for (int i = 0; i < 3; ++i) out[i] = colour[i];
  });
}

}  // namespace
}  // namespace malus::f32

#include "shaders/optics/language_end.h"
