// The packet tracer of one method for one instruction set. Included by hwy/foreach_target.h once per instruction set;
// no include guard. MALUS_METHOD_HEADER and MALUS_PACKET_DRIVER name the files of the method and of its driver.
#include "shaders/optics/language_begin.h"
#undef CONST_REAL
#define CONST_REAL(name, value) CONST float name = static_cast<float>(value)
#undef SELECT
#define SELECT(m, a, b) selectFields(m, a, b)
#if defined(MALUS_PACKETS_iterative) && MALUS_EFFECT_ROUGHNESS  // of facets only reflectances may be needed
#undef FN_TERMS
#define FN_TERMS FN_INLINE
#endif

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"

HWY_BEFORE_NAMESPACE();
namespace malus::packets::HWY_NAMESPACE {
namespace {

using namespace gpu;
using embree::kBatch;

#include "render/embree/packets/lanes-inl.h"

#include "shaders/gpu/material.h"
#include "shaders/optics/all.h"

struct Method {
#include MALUS_METHOD_HEADER
};

#include "render/embree/packets/access-inl.h"

#ifdef MALUS_BUILD_every
// An effect that is compiled in costs a branch where the image does not need it.
#define EFFECT_CONST const
#define EFFECT_IS_ON(id, compiled) ((imageEffects & shaders::effectBit(shaders::Effect::k##id)) != 0)
#else
#define EFFECT_CONST static constexpr
#define EFFECT_IS_ON(id, compiled) (compiled != 0)
#endif

// Bits of the effects that the image needs.
struct ActiveEffects {
  std::uint32_t imageEffects;
};

struct Tracer : Method, ActiveEffects, PacketAccess {
  explicit Tracer(std::uint32_t effects) : ActiveEffects{effects} {}
#undef FN
#define FN                                       // members
  static constexpr bool kCheckNumerics = false;  // the scalar tracers check (render/embree/method_tracer.h)
#include "shaders/surfaces/steps.h"

#include "shaders/surfaces/mesh_textures.h"
#include "shaders/surfaces/placed_texture.h"

#include "render/embree/packets/hits-inl.h"
// clang-format off
#include "shaders/surfaces/camera_colour.h"
#include "shaders/surfaces/environment.h"
#include "shaders/surfaces/shadows.h"
#include "shaders/surfaces/sampled_lights.h"
#include "shaders/surfaces/direct_light.h"
#include "shaders/surfaces/sample_direction.h"
#include "shaders/surfaces/surface_kinds.h"
#include "shaders/surfaces/textures.h"
// clang-format on
#include MALUS_PACKET_DRIVER
};

embree::TileOutput renderTile(const embree::TileInput& tile, const embree::ShadingOrder& order,
                              embree::PacketMemory& memory) {
  if (!memory.tracer)
    memory.tracer = {new Tracer(tile.effects), [](void* t) HWY_ATTR {
                       static_cast<Tracer*>(t)->freeLevels();
                       delete static_cast<Tracer*>(t);
                     }};
  Tracer& tracer = *static_cast<Tracer*>(memory.tracer.get());
  tracer.begin({tile, &order, memory.bucketEnds});
  tracer.renderTile(tile);
  return {tracer.rays, {}};
}

}  // namespace
}  // namespace malus::packets::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#undef EFFECT_CONST
#undef EFFECT_IS_ON
#pragma GCC diagnostic pop
#include "shaders/optics/language_end.h"
