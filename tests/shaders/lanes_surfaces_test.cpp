// The steps of the surfaces on a two-lane type: each lane has the scalar build's result, bit by bit.
#include <cstring>
#include <tuple>

#include "shaders/gpu/scene.h"
#include "shaders/methods/methods.h"
#include "tests/shaders/lanes.h"
#include "tests/shaders/optics_types.h"

#include "shaders/optics/language_begin.h"
#undef FN
#define FN  // members
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace malus::f32 {
using namespace gpu;
#include "tests/shaders/surface_steps.h"
}  // namespace malus::f32
namespace malus::lanes32 {
using namespace gpu;
#include "shaders/gpu/material.h"

#include "tests/shaders/surface_steps.h"
}  // namespace malus::lanes32
#pragma GCC diagnostic pop
#include "shaders/optics/language_end.h"

namespace malus::test {
namespace {

using Lane = lanes32::real;
using Lane3 = lanes32::real3;
using Mask = lanes32::mask;
using Word = lanes32::word;
using Vec = f32::real3;

Lane pack(float a, float b) { return {a, b}; }
Lane3 pack(const Vec& a, const Vec& b) { return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}}; }
Word pack(std::uint32_t a, std::uint32_t b) { return {a, b}; }

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }
void expectSame(const Lane& l, float a, float b, const char* what) {
  EXPECT_TRUE(same(l.lane[0], a) && same(l.lane[1], b))
      << what << ": " << l.lane[0] << ", " << l.lane[1] << " instead of " << a << ", " << b;
}
void expectSame(const Lane3& l, const Vec& a, const Vec& b, const char* what) {
  expectSame(l.x, a.x, b.x, what);
  expectSame(l.y, a.y, b.y, what);
  expectSame(l.z, a.z, b.z, what);
}
void expectSame(const Mask& l, bool a, bool b, const char* what) {
  EXPECT_TRUE(l.lane[0] == a && l.lane[1] == b) << what;
}
void expectSame(const Word& l, std::uint32_t a, std::uint32_t b, const char* what) {
  EXPECT_TRUE(l.lane[0] == a && l.lane[1] == b) << what;
}
// Structs of numbers alone, such as FresnelTerms.
template <class LaneStruct, class Struct>
void expectSameNumbers(const LaneStruct& l, const Struct& a, const Struct& b, const char* what) {
  constexpr std::size_t kCount = sizeof(Struct) / sizeof(float);
  static_assert(sizeof(LaneStruct) == 2 * sizeof(Struct));
  float got[2 * kCount], first[kCount], second[kCount];
  std::memcpy(got, &l, sizeof(l));
  std::memcpy(first, &a, sizeof(a));
  std::memcpy(second, &b, sizeof(b));
  for (std::size_t i = 0; i < kCount; ++i)
    EXPECT_TRUE(same(got[2 * i], first[i]) && same(got[2 * i + 1], second[i])) << what << " number " << i;
}

// Fields of the structs that mix numbers, masks and words.
#define MALUS_HIT(X) \
  X(d) X(position) X(start) X(error) X(face) X(normal) X(c) X(outside) X(depth) X(material) X(travelled) X(rounding)
#define MALUS_MATERIAL(X) \
  X(eta)                  \
  X(contrast)             \
  X(k)                    \
  X(albedo)               \
  X(radiance) X(hemisphereTransmittance) X(outsideEta) X(basicScale) X(highlightStrength) X(highlightExponent) X(kind)
// clang-format off
#define MALUS_EXTRA(X)                                                                                        \
  X(absorption) X(outsideAbsorption) X(axis) X(degree) X(transmittanceParallel) X(transmittanceCrossed)       \
  X(retardanceCos) X(retardanceSin) X(filmEta) X(filmOverOutside) X(filmOverBase) X(roundTripPhase)           \
  X(outsideResidue) X(filmResidue) X(roughness) X(albedoMap) X(etaMap) X(kMap) X(mapOrigin) X(mapU) X(mapV)   \
  X(specularFactor) X(coatShare) X(coatEta)
// clang-format on

// Both lanes' scalar inputs, and the two of them packed.
template <class S, class L>
struct Inputs {
  S scalar[2];
  L lanes;
  typename S::Hit hit[2];
  typename L::Hit laneHit;
  gpu::Material material[2];
  lanes32::Material laneMaterial;
  gpu::PointLight light[2];
  lanes32::PointLight laneLight;
};

Vec direction(Draw& draw) { return toReal3<F32>(draw.direction()); }
float number(Draw& draw, double a, double b) { return static_cast<float>(draw.between(a, b)); }
Vec numbers(Draw& draw, double a, double b) { return {number(draw, a, b), number(draw, a, b), number(draw, a, b)}; }

gpu::Material drawMaterial(Draw& draw) {
  static constexpr gpu::SurfaceKind kKinds[] = {gpu::kPaint, gpu::kMetal, gpu::kGlass, gpu::kEmitter};
  gpu::Material m{};
  m.eta = numbers(draw, 0.2, 2.5);
  m.k = numbers(draw, 0, 4);
  m.albedo = numbers(draw, 0, 1);
  m.radiance = numbers(draw, 0, 5);
  m.outsideEta = draw.below(3) == 0 ? 1.5f : 1.0f;
  m.contrast = m.eta - m.outsideEta + numbers(draw, -1e-8, 1e-8);
  m.basicScale = 1 / (m.outsideEta * m.outsideEta);
  m.highlightStrength = number(draw, 0, 1);
  m.highlightExponent = static_cast<gpu::uint>(draw.below(4096));
  m.kind = kKinds[draw.below(4)];
  return m;
}
gpu::MaterialExtra drawExtra(Draw& draw) {
  gpu::MaterialExtra e{};
  e.absorption = numbers(draw, 0, 2);
  e.outsideAbsorption = draw.below(2) == 0 ? Vec(0.5f) : numbers(draw, 0, 2);
  e.axis = direction(draw);
  e.degree = number(draw, 0, 1);
  e.transmittanceParallel = numbers(draw, 0, 1);
  e.transmittanceCrossed = numbers(draw, 0, 1);
  e.retardanceCos = numbers(draw, -1, 1);
  e.retardanceSin = numbers(draw, -1, 1);
  if (draw.below(2) == 0) e.filmEta = numbers(draw, 1.2, 2.4);
  e.filmOverOutside = e.filmEta - numbers(draw, 1, 1.5);
  e.filmOverBase = e.filmEta - numbers(draw, 0.2, 2.5);
  e.outsideResidue = number(draw, -1e-8, 1e-8);
  e.filmResidue = numbers(draw, -1e-8, 1e-8);
  e.etaMap = draw.below(2) == 0 ? gpu::kNoTexture : 0;
  e.roundTripPhase = numbers(draw, 0, 2);
  e.roughness = draw.below(2) == 0 ? 0 : number(draw, 0.01, 1);
  e.specularFactor = draw.below(2) == 0 ? 1 : number(draw, 0, 1);
  e.coatShare = draw.below(2) == 0 ? 0 : number(draw, 0, 1);
  e.coatEta = draw.below(4) == 0 ? 1.5f : number(draw, 1, 2);
  return e;
}

// Makes the hits too, and compares them.
template <class S, class L>
Inputs<S, L> drawInputs(Draw& draw) {
  Inputs<S, L> in;
  Vec corner[2][3], origin[2], from[2], d[2], normal[2];
  float b1[2], b2[2], depth[2], distance[2];
  for (int i = 0; i < 2; ++i) {
    for (Vec& p : corner[i]) p = numbers(draw, -2, 2);
    origin[i] = draw.below(2) == 0 ? Vec(0) : numbers(draw, -100, 100);
    d[i] = direction(draw);
    b1[i] = draw.below(3) == 0 ? 1e-7f : number(draw, 0, 0.5);  // on an edge, or inside
    b2[i] = number(draw, 0, 0.5);
    // Rays shorter than the triangle, and longer ones.
    from[i] = origin[i] + corner[i][0] + (corner[i][1] - corner[i][0]) * b1[i] + (corner[i][2] - corner[i][0]) * b2[i] -
              d[i] * number(draw, 0, 8);
    const Vec face = f32::cross3(corner[i][1] - corner[i][0], corner[i][2] - corner[i][0]);
    normal[i] = draw.below(3) == 0 ? Vec(0) : face + numbers(draw, -0.5, 0.5);
    depth[i] = static_cast<float>(draw.below(3)) + (draw.below(4) == 0 ? 0.25f : 0.0f);
    distance[i] = number(draw, 0, 3);
    in.hit[i] =
        in.scalar[i].makeHit(in.scalar[i].makeRay(from[i], d[i], depth[i], distance[i]), corner[i][0], corner[i][1],
                             corner[i][2], b1[i], b2[i], origin[i], normal[i], static_cast<gpu::uint>(i));
    in.material[i] = drawMaterial(draw);
    in.light[i] = {numbers(draw, -3, 3), numbers(draw, 0, 10)};
    in.scalar[i].extra = drawExtra(draw);
  }
  const auto ray = in.lanes.makeRay(pack(from[0], from[1]), pack(d[0], d[1]), pack(depth[0], depth[1]),
                                    pack(distance[0], distance[1]));
  in.laneHit = in.lanes.makeHit(ray, pack(corner[0][0], corner[1][0]), pack(corner[0][1], corner[1][1]),
                                pack(corner[0][2], corner[1][2]), pack(b1[0], b1[1]), pack(b2[0], b2[1]),
                                pack(origin[0], origin[1]), pack(normal[0], normal[1]), Word(0u, 1u));
  const auto& hit = in.hit;
#define MALUS_SAME_FIELD(f) expectSame(in.laneHit.f, hit[0].f, hit[1].f, "makeHit " #f);
  MALUS_HIT(MALUS_SAME_FIELD)
#define MALUS_PACK_FIELD(f) in.laneMaterial.f = pack(in.material[0].f, in.material[1].f);
  MALUS_MATERIAL(MALUS_PACK_FIELD)
#define MALUS_PACK_EXTRA(f) in.lanes.extra.f = pack(in.scalar[0].extra.f, in.scalar[1].extra.f);
  MALUS_EXTRA(MALUS_PACK_EXTRA)
  in.laneLight.position = pack(in.light[0].position, in.light[1].position);
  in.laneLight.intensity = pack(in.light[0].intensity, in.light[1].intensity);
  return in;
}

template <class LaneScattering, class Scattering>
void expectSameScattering(const LaneScattering& l, const Scattering& a, const Scattering& b, const char* what) {
  expectSame(l.frameNormal, a.frameNormal, b.frameNormal, what);
  expectSame(l.reflects, a.reflects, b.reflects, what);
  expectSame(l.transmits, a.transmits, b.transmits, what);
  expectSame(l.coloured, a.coloured, b.coloured, what);
  if (a.reflects && b.reflects) {
    expectSameNumbers(l.reflection, a.reflection, b.reflection, what);
    expectSame(l.reflected, a.reflected, b.reflected, what);
  }
  if (a.transmits && b.transmits) {
    expectSameNumbers(l.transmission, a.transmission, b.transmission, what);
    expectSame(l.transmitted, a.transmitted, b.transmitted, what);
  }
}

// Calls a step on both lanes and on each scalar: step(steps, hit, material, light).
#define MALUS_RUN(step)                                                          \
  const auto lane = step(in.lanes, in.laneHit, in.laneMaterial, in.laneLight);   \
  const auto first = step(in.scalar[0], in.hit[0], in.material[0], in.light[0]); \
  const auto second = step(in.scalar[1], in.hit[1], in.material[1], in.light[1]);

template <class S, class L>
void compareScattering(Inputs<S, L>& in) {
  {
    MALUS_RUN([](auto& s, auto& h, auto& m, auto&) { return s.scatterPaint(h, m); })
    expectSameScattering(lane, first, second, "paint");
  }
  {
    MALUS_RUN([](auto& s, auto& h, auto& m, auto&) { return s.scatterMetal(h, m); })
    expectSameScattering(lane, first, second, "metal");
  }
  {
    MALUS_RUN([](auto& s, auto h, auto& m, auto&) { return s.scatterGlass(h, m); })
    expectSameScattering(lane, first, second, "glass");
  }
  {
    MALUS_RUN([](auto& s, auto& h, auto& m, auto&) { return s.scatterPolarizingElement(h, m); })
    expectSameScattering(lane, first, second, "polarizing element");
  }
  {
    MALUS_RUN([](auto& s, auto& h, auto& m, auto&) { return s.opaqueTerms(h.c, m, h.material); })
    expectSameNumbers(lane, first, second, "opaqueTerms");
  }
}

template <class S, class L>
void compareLight(Inputs<S, L>& in) {
  {
    MALUS_RUN([](auto& s, auto& h, auto&, auto&) { return s.mediumTransmittance(h); })
    expectSame(lane, first, second, "mediumTransmittance");
  }
  {
    MALUS_RUN([](auto& s, auto& h, auto& m, auto&) { return s.emission(h, m); })
    expectSame(lane, first, second, "emission");
  }
  {
    MALUS_RUN([](auto& s, auto& h, auto& m, auto&) { return s.enteringRow(h, m, h.d, h.c); })
    expectSame(lane.w, first.w, second.w, "enteringRow w");
    expectSame(lane.q, first.q, second.q, "enteringRow q");
  }
  {
    MALUS_RUN(([](auto& s, auto& h, auto& m, auto& light) {
      return s.sampleLight(h, m, light, h.normal, h.outside, s.isRough(h));
    }))
    expectSame(lane.direction, first.direction, second.direction, "sampleLight direction");
    expectSame(lane.lobe, first.lobe, second.lobe, "sampleLight lobe");
    expectSame(lane.lit, first.lit, second.lit, "sampleLight lit");
    const auto laneRay = in.lanes.shadowRay(in.laneHit, lane.toLight);
    const auto firstRay = in.scalar[0].shadowRay(in.hit[0], first.toLight),
               secondRay = in.scalar[1].shadowRay(in.hit[1], second.toLight);
    expectSame(laneRay.origin, firstRay.origin, secondRay.origin, "shadowRay origin");
    expectSame(laneRay.way, firstRay.way, secondRay.way, "shadowRay way");
    expectSame(in.lanes.lightIrradiance(in.laneHit, in.laneLight, lane),
               in.scalar[0].lightIrradiance(in.hit[0], in.light[0], first),
               in.scalar[1].lightIrradiance(in.hit[1], in.light[1], second), "lightIrradiance");
  }
}

template <class S, class L>
void compareFacets(Inputs<S, L>& in, Draw& draw) {
  {
    MALUS_RUN([](auto& s, auto& h, auto&, auto&) { return s.isRough(h); })
    expectSame(lane, first, second, "isRough");
  }
  for (gpu::MaterialExtra* e : {&in.scalar[0].extra, &in.scalar[1].extra})
    if (e->roughness == 0) e->roughness = 0.1f;
  in.lanes.extra.roughness = pack(in.scalar[0].extra.roughness, in.scalar[1].extra.roughness);
  const float x = number(draw, -0.7, 0.7), y = number(draw, -0.7, 0.7);
  MALUS_RUN([](auto& s, auto& h, auto&, auto&) { return s.visibleFacetsAt(h); })
  expectSameNumbers(lane, first, second, "visibleFacetsAt");
  expectSameNumbers(in.lanes.sampleFacet(in.laneHit, lane, pack(x, x), pack(y, y)),
                    in.scalar[0].sampleFacet(in.hit[0], first, x, y), in.scalar[1].sampleFacet(in.hit[1], second, x, y),
                    "sampleFacet");
}

template <class S, class L>
void compareTexels(S& s, L& l, Draw& draw) {
  const Vec d[2] = {direction(draw), direction(draw)};
  expectSameNumbers(l.environmentTexelPosition(pack(d[0], d[1]), Lane(16)), s.environmentTexelPosition(d[0], 16),
                    s.environmentTexelPosition(d[1], 16), "environmentTexelPosition");
  const float u[2] = {number(draw, -3, 3), number(draw, -3, 3)}, v[2] = {number(draw, -3, 3), number(draw, -3, 3)};
  expectSameNumbers(l.textureTexelPosition(pack(u[0], u[1]), pack(v[0], v[1]), Lane(7), Lane(5)),
                    s.textureTexelPosition(u[0], v[0], 7, 5), s.textureTexelPosition(u[1], v[1], 7, 5),
                    "textureTexelPosition");
  expectSame(l.bilinear(pack(d[0], d[1]), pack(d[1], d[0]), pack(d[0], d[0]), pack(d[1], d[1]), pack(u[0], u[1]),
                        pack(v[0], v[1])),
             s.bilinear(d[0], d[1], d[0], d[1], u[0], v[0]), s.bilinear(d[1], d[0], d[0], d[1], u[1], v[1]),
             "bilinear");
}

template <class S, class L>
void compareSteps() {
  Draw draw(52);
  for (int i = 0; i < 400 && !::testing::Test::HasFailure(); ++i) {
    Inputs<S, L> in = drawInputs<S, L>(draw);
    compareScattering(in);
    compareLight(in);
    compareFacets(in, draw);
    compareTexels(in.scalar[0], in.lanes, draw);
  }
}

// Light and throughput along a path of a few surfaces; each lane splits its colours where its own materials ask for it.
template <class S, class L>
void comparePaths() {
  Draw draw(53);
  for (int i = 0; i < 400 && !::testing::Test::HasFailure(); ++i) {
    const Vec up[2] = {direction(draw), direction(draw)}, behind = numbers(draw, 0, 0.5);
    const float tolerance = draw.below(2) == 0 ? 0 : 0.1f;
    typename S::CameraPath path[2];
    typename L::CameraPath lanePath;
    for (int bounce = 0; bounce < 4; ++bounce) {
      Inputs<S, L> in = drawInputs<S, L>(draw);
      const auto step = [&](auto& steps, auto h, const auto& m, auto& p, const auto& upward, auto scalar, int kind) {
        if (bounce == 0)
          p.throughput = steps.startThroughput(h.d, upward, scalar(1), scalar(behind.x), scalar(behind.y), scalar(0));
        steps.scaleThroughput(p.throughput, steps.mediumTransmittance(h));
        auto s = steps.scatterGlass(h, m);
        if (kind == 1) s = steps.scatterMetal(h, m);
        if (kind == 2) s = steps.scatterPolarizingElement(h, m);
        steps.rotateToSurface(p.throughput, h.d, s.frameNormal);
        const auto diffuse = steps.diffuseExit(p.throughput, steps.opaqueTerms(h.c, m, h.material), m.albedo);
        if (kind == 2) {
          steps.followTransmission(p, h, s, scalar(tolerance));
        } else {
          steps.applyInterface(p.throughput, s.reflection, s.coloured);
          steps.followReflection(p, h, s, scalar(tolerance));
        }
        const auto light = steps.emitterLight(h, m, p.throughput);
        return std::tuple{diffuse, light.recorded, light.emitted, steps.unpolarizedContribution(p.throughput, m.albedo),
                          steps.maxComponent(p.throughput)};
      };
      const int kind = static_cast<int>(draw.below(3));
      const auto toLane = [](float x) { return Lane(x); };
      const auto toFloat = [](float x) { return x; };
      const auto lane = step(in.lanes, in.laneHit, in.laneMaterial, lanePath, pack(up[0], up[1]), toLane, kind);
      const auto first = step(in.scalar[0], in.hit[0], in.material[0], path[0], up[0], toFloat, kind);
      const auto second = step(in.scalar[1], in.hit[1], in.material[1], path[1], up[1], toFloat, kind);
      expectSame(std::get<0>(lane), std::get<0>(first), std::get<0>(second), "diffuseExit");
      expectSame(std::get<1>(lane), std::get<1>(first), std::get<1>(second), "emitterLight");
      expectSame(std::get<2>(lane), std::get<2>(first), std::get<2>(second), "emission");
      expectSame(std::get<3>(lane), std::get<3>(first), std::get<3>(second), "unpolarizedContribution");
      expectSame(std::get<4>(lane), std::get<4>(first), std::get<4>(second), "maxComponent");
      expectSame(lanePath.ray.origin, path[0].ray.origin, path[1].ray.origin, "origin");
      expectSame(lanePath.ray.d, path[0].ray.d, path[1].ray.d, "direction");
      expectSame(lanePath.ray.depth, path[0].ray.depth, path[1].ray.depth, "depth");
      expectSame(lanePath.ray.originDistance, path[0].ray.originDistance, path[1].ray.originDistance, "originDistance");
    }
  }
}

TEST(LanesTest, SurfaceStepsOfSchlick) { compareSteps<f32::SchlickSteps, lanes32::SchlickSteps>(); }
TEST(LanesTest, SurfaceStepsOfPowers) { compareSteps<f32::PowersSteps, lanes32::PowersSteps>(); }
TEST(LanesTest, SurfaceStepsOfStokes) { compareSteps<f32::StokesSteps, lanes32::StokesSteps>(); }
TEST(LanesTest, PathStepsOfFresnel) { comparePaths<f32::FresnelPathSteps, lanes32::FresnelPathSteps>(); }
TEST(LanesTest, PathStepsOfImportance) { comparePaths<f32::ImportancePathSteps, lanes32::ImportancePathSteps>(); }

}  // namespace
}  // namespace malus::test
