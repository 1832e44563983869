// The recursive tracer of one method. Included once by a generated file for each method, which defines
// MALUS_METHOD as the method's struct. The shared surfaces become members, so that they see the method, the
// scene and traceRay by their own names.
#include "render/embree/tile.h"
#include "shaders/methods/methods.h"

#include "shaders/optics/language_begin.h"
#undef FN
#define FN  // members

namespace malus::f32 {
namespace {

using namespace malus::gpu;

template <bool kCheckNumerics>
struct Tracer : MALUS_METHOD {
  explicit Tracer(const embree::TileInput& tile)
      : bvh(*tile.bvh),
        scene(*tile.scene),
        frame(*tile.frame),
        lights(scene.lights.data()),
        environmentTexels(scene.environmentTexels.data()) {}

  const embree::Bvh& bvh;
  const render::FloatScene& scene;
  const Frame& frame;
  const PointLight* lights;
  const real3* environmentTexels;
  std::uint64_t rays = 0;
  uint pixelX = 0, pixelY = 0;  // the pixel at hand, of the whole picture
  render::Faults faults;

  bool visible(real3 origin, real3 direction, real distance) {
    ++rays;
    return bvh.visible(origin, direction, distance);
  }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/surfaces/all.h"
#pragma GCC diagnostic pop

  void noteFault(const Hit& h, const vec4& stokes, uint kind, uint colour, float slack) {
    faults.note({kind, pixelX, pixelY, frame.depth - static_cast<int>(h.depth), h.material, colour, h.c, slack,
                 h.position, h.d, h.normal, stokes},
                frame.width);
  }

  Payload traceRay(real3 origin, real3 direction, real depth) {
    ++rays;
    const embree::Intersection at = bvh.nearest(origin, direction);
    if (at.mesh == embree::Intersection::kMiss) return shadeMiss(direction, depth);
    const Mesh& mesh = scene.meshes[at.mesh];
    const glm::uvec3 corner = scene.triangles[mesh.firstTriangle + at.triangle];
    const real3* p = scene.positions.data() + mesh.firstVertex;
    const real3* n = scene.normals.data() + mesh.firstVertex;
    const real b0 = 1 - at.b1 - at.b2;
    const real3 interpolated =
        mesh.hasNormals != 0 ? n[corner.x] * b0 + n[corner.y] * at.b1 + n[corner.z] * at.b2 : real3(0);
    const Material& material = scene.materials[mesh.material];
    const Hit hit =
        makeHit(direction, p[corner.x], p[corner.y], p[corner.z], at.b1, at.b2, interpolated, depth, mesh.material);
    switch (material.kind) {
      case kLambert:
        return shadeLambert(hit, material);
      case kPaint:
        return shadePaint(hit, material);
      case kMetal:
        return shadeMetal(hit, material);
      case kGlass:
        return shadeGlass(hit, material);
      default:
        return shadeEmitter(hit, material);
    }
  }
};

template <bool kCheckNumerics>
embree::TileOutput renderTile(const embree::TileInput& tile) {
  Tracer<kCheckNumerics> tracer(tile);
  const Frame& frame = *tile.frame;
  constexpr std::size_t kChannels = MALUS_METHOD::kHasStokes != 0 ? 15 : 3;
  for (std::uint32_t y = tile.beginY; y < tile.endY; ++y)
    for (std::uint32_t x = tile.beginX; x < tile.endX; ++x) {
      tracer.pixelX = x + frame.regionX;
      tracer.pixelY = y + frame.regionY;
      const Stokes s = tracer.cameraPixel(tracer.pixelX, tracer.pixelY);
      const real3 colour = tracer.cameraColour(s);
      float* out = tile.pixels + (std::size_t{y} * frame.regionWidth + x) * kChannels;
      const real3 values[5] = {colour, s.s0, s.s1, s.s2, s.s3};
      for (std::size_t i = 0; i < kChannels; ++i) out[i] = values[i / 3][static_cast<int>(i % 3)];
    }
  return {tracer.rays, tracer.faults};
}

}  // namespace
}  // namespace malus::f32

#include "shaders/optics/language_end.h"
