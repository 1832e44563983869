// Recursive tracer of one method. A generated file per build of a method defines MALUS_METHOD, the method's struct, and
// every MALUS_EFFECT_ macro as 1 or 0, and includes this once.
#include "render/embree/scene_access.h"

#include "shaders/optics/language_begin.h"
#undef FN
#define FN  // members

// The case of a kind of surface that this build contains (1) or does not (0).
#define MALUS_SURFACE_CASE(isCompiled, id) MALUS_SURFACE_CASE_EXPANDED(isCompiled, id)
#define MALUS_SURFACE_CASE_EXPANDED(isCompiled, id) MALUS_SURFACE_CASE_##isCompiled(id)
#define MALUS_SURFACE_CASE_0(id)
#define MALUS_SURFACE_CASE_1(id) \
  case k##id:                    \
    return shade##id(hit, material);

namespace malus::f32 {
namespace {

using namespace malus::gpu;

template <bool kCheckNumerics>
struct Tracer : MALUS_METHOD, embree::SceneAccess {
  using SceneAccess::SceneAccess;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/surfaces/recursive.h"
#pragma GCC diagnostic pop

#include "render/embree/find_hit.h"

  Payload traceRay(const Ray& ray) {
    Hit hit;
    if (!findHit(ray, hit)) return shadeEnvironment(ray.d, ray.depth);
#if MALUS_EFFECT_TEXTURES || MALUS_EFFECT_MESH_TEXTURES
    const Material material = materialAt(hit);
#else
    const Material& material = materials[hit.material];
#endif
    switch (material.kind) {
#define MALUS_SURFACE_ROW(id, macro, ...) MALUS_SURFACE_CASE(MALUS_EFFECT_##macro, id)
#include "shaders/effects.def"
      default:  // no other kind is in a scene that this build renders
        return shadeEmitter(hit, material);
    }
  }
};

template <bool kCheckNumerics>
embree::TileOutput renderTile(const embree::TileInput& tile) {
  constexpr std::size_t kChannels = MALUS_METHOD::kHasStokes != 0 ? kStokesChannels : kColourChannels;
  return embree::renderPixels<Tracer<kCheckNumerics>>(tile, kChannels, [](auto& tracer, float* out) {
    const Stokes s = tracer.cameraPixel(tracer.pixelX, tracer.pixelY);
    const real3 values[5] = {tracer.cameraColour(s), s.s0, s.s1, s.s2, s.s3};
    for (std::size_t i = 0; i < kChannels; ++i) out[i] = values[i / 3][static_cast<int>(i % 3)];
  });
}

}  // namespace
}  // namespace malus::f32

#include "shaders/optics/language_end.h"
