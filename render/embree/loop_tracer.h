// The tracer of one method that follows the eye's path in a loop. Included once by a generated file for each, which
// defines MALUS_METHOD as the loop's struct.
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
  static constexpr int kStackSize = pack::kMaxDepth;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/surfaces/common.h"

#include "shaders/loops/eye_path.h"
#pragma GCC diagnostic pop

#include "render/embree/find_hit.h"
};

template <bool kCheckNumerics>
embree::TileOutput renderTile(const embree::TileInput& tile) {
  return embree::renderPixels<Tracer<kCheckNumerics>>(tile, 3, [](auto& tracer, float* out) {
    const real3 colour = tracer.eyePathPixel(tracer.pixelX, tracer.pixelY);
    for (int i = 0; i < 3; ++i) out[i] = colour[i];
  });
}

}  // namespace
}  // namespace malus::f32

#include "shaders/optics/language_end.h"
