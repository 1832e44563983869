// The packet tracer of one method for one instruction set. Included by hwy/foreach_target.h once per instruction set;
// no include guard. MALUS_METHOD_HEADER and MALUS_PACKET_DRIVER name the files of the method and of its driver.
#include "shaders/optics/language_begin.h"
#undef CONST_REAL
#define CONST_REAL(name, value) CONST float name = static_cast<float>(value)
#undef SELECT
#define SELECT(m, a, b) selectFields(m, a, b)

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

struct Tracer : Method, PacketAccess {
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
    memory.tracer = {new Tracer, [](void* t) HWY_ATTR {
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

#pragma GCC diagnostic pop
#include "shaders/optics/language_end.h"
