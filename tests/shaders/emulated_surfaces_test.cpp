// The steps of the surfaces with the precision that the Vulkan specification guarantees: hits, scattering and camera
// paths stay finite and physical.
#include "shaders/gpu/scene.h"
#include "tests/shaders/optics_types.h"

#include "shaders/optics/language_begin.h"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace malus::emulated {
using namespace gpu;
#include "shaders/gpu/material.h"

#include "lane_methods.h"
#undef FN
#define FN  // members
#include "tests/shaders/surface_steps.h"
}  // namespace malus::emulated
#pragma GCC diagnostic pop
#include "shaders/optics/language_end.h"

namespace malus::test {
namespace {

using emulated::StokesSteps;
using oracle::Real;
using oracle::Vec;
using real = emulation::Float;
using real3 = emulation::Three;

constexpr double kUnit = kEmulatedRoundings * double(std::numeric_limits<float>::epsilon());

template <class O>
class EmulatedSurfaces : public ::testing::Test {
 protected:
  EmulatedSurfaces() { O::enter(); }
};
TYPED_TEST_SUITE(EmulatedSurfaces, OpticsTypes, OpticsNames);

Vec toVec(const real3& v) { return {v.x.value, v.y.value, v.z.value}; }
real3 vector(const Vec& v) { return {real(v[0]), real(v[1]), real(v[2])}; }
real number(Draw& draw, double a, double b) { return real(draw.between(a, b)); }
real3 numbers(Draw& draw, double a, double b) { return {number(draw, a, b), number(draw, a, b), number(draw, a, b)}; }

emulated::Material drawMaterial(Draw& draw) {
  emulated::Material m{};
  m.eta = numbers(draw, 0.2, 2.5);
  if (draw.below(4) == 0) m.eta.y = real(1.0001);
  m.k = numbers(draw, 0, 4);
  m.albedo = numbers(draw, 0, 1);
  m.outsideEta = real(draw.below(3) == 0 ? 1.5 : 1.0);
  m.contrast = {m.eta.x - m.outsideEta, m.eta.y - m.outsideEta, m.eta.z - m.outsideEta};
  m.highlightStrength = number(draw, 0, 1);
  m.highlightExponent = static_cast<std::uint32_t>(draw.below(4096));
  m.kind = draw.below(2) == 0 ? gpu::kPaint : gpu::kMetal;
  return m;
}
emulated::MaterialExtra drawExtra(Draw& draw, const emulated::Material& m) {
  emulated::MaterialExtra e{};
  e.absorption = draw.below(2) == 0 ? real3{real(0), real(0), real(0)} : numbers(draw, 0, 2);
  e.outsideAbsorption = e.absorption;
  e.axis = vector(draw.direction());
  e.transmittanceParallel = draw.below(3) == 0 ? real3{real(1), real(1), real(1)} : numbers(draw, 0, 1);
  e.transmittanceCrossed = numbers(draw, 0, 1);
  const double delay = draw.between(0, 6.28);
  e.retardanceCos = {real(std::cos(delay)), real(1), real(0)};
  e.retardanceSin = {real(std::sin(delay)), real(0), real(1)};
  if (draw.below(2) == 0) {
    e.filmEta = numbers(draw, 1.2, 2.4);
    const real3 base = m.kind == gpu::kMetal ? m.eta : real3{m.eta.y, m.eta.y, m.eta.y};
    e.filmOverOutside = {e.filmEta.x - m.outsideEta, e.filmEta.y - m.outsideEta, e.filmEta.z - m.outsideEta};
    e.filmOverBase = {e.filmEta.x - base.x, e.filmEta.y - base.y, e.filmEta.z - base.z};
  }
  e.etaMap = draw.below(2) == 0 ? gpu::kNoTexture : 0u;
  e.roundTripPhase = numbers(draw, 0, 2);
  e.roughness = number(draw, 0.01, 1);
  e.specularFactor = draw.below(2) == 0 ? real(1) : number(draw, 0, 1);
  e.coatShare = draw.below(2) == 0 ? real(0) : number(draw, 0, 1);
  e.coatEta = draw.below(2) == 0 ? real(1.5) : number(draw, 1, 2);
  return e;
}

// A ray that meets a triangle of a size from 1 mm to 10 m, up to 100 m from the origin; some at grazing incidence.
struct Corners {
  Vec p[3];
};
template <class Steps>
typename Steps::Hit drawHit(Draw& draw, Steps& steps, Corners& corners) {
  const Real size = std::pow(10.0L, draw.between(-3, 1));
  const Vec at = draw.direction();
  for (Vec& p : corners.p) p = toVec(vector(oracle::along(at, draw.between(0, 100), draw.direction(), size)));
  corners.p[1] = toVec(vector(oracle::along(corners.p[0], 1, draw.direction(), size)));
  corners.p[2] = toVec(vector(oracle::along(corners.p[0], 1, draw.direction(), size)));
  const Vec n =
      oracle::cross(oracle::along(corners.p[1], 1, corners.p[0], -1), oracle::along(corners.p[2], 1, corners.p[0], -1));
  Vec d = draw.direction();
  if (draw.below(4) == 0) {
    const Vec across = oracle::unit(oracle::cross(n, d));
    d = oracle::unit(oracle::along(across, 1, oracle::unit(n), -std::pow(10.0L, -draw.between(1, 8))));
  }
  const real b1 = draw.below(3) == 0 ? real(1e-7) : number(draw, 0, 0.5), b2 = number(draw, 0, 0.5);
  const real3 none{real(0), real(0), real(0)};
  Vec origin = corners.p[0];
  for (std::size_t i = 1; i < 3; ++i) {
    const Real b = i == 1 ? Real(b1.value) : Real(b2.value);
    origin = oracle::along(origin, 1, oracle::along(corners.p[i], b, corners.p[0], -b), 1);
  }
  origin = oracle::along(origin, 1, d, -size * std::pow(10.0L, draw.between(-3, 3)));
  const auto ray = steps.makeRay(vector(origin), vector(d), real(draw.below(3)), real(0));
  auto h = steps.makeHit(ray, vector(corners.p[0]), vector(corners.p[1]), vector(corners.p[2]), b1, b2, none, none, 0u);
  h.travelled = draw.below(3) == 0 ? real(0) : number(draw, 0, 3);
  return h;
}

// steps: number of constructions, each from the result before it.
void expectUnit(const real3& v, const char* what, int steps = 1) {
  EXPECT_CLOSE(oracle::dot(toVec(v), toVec(v)), 1, 6 * kUnit * steps) << what;
}
void expectShare(const real3& v, const char* what) {
  for (const Real x : toVec(v)) EXPECT_TRUE(x >= 0 && x <= 1) << what << ' ' << x;
}
// Powers in [0, 1], and light that is fully polarized at most: |X|^2 <= R_s R_p.
template <class Terms>
void expectTerms(const Terms& f, const char* what) {
  expectShare(f.rs, what);
  expectShare(f.rp, what);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LE(std::hypot(toVec(f.xRe)[i], toVec(f.xIm)[i]), std::sqrt(toVec(f.rs)[i] * toVec(f.rp)[i]) + 8 * kUnit)
        << what;
}
template <class Scattering>
void expectScattering(const Scattering& s, const char* what) {
  if (s.reflects) {
    expectTerms(s.reflection, what);
    expectUnit(s.reflected, what);
  }
  if (s.transmits) {
    expectTerms(s.transmission, what);
    expectUnit(s.transmitted, what);
  }
}

TYPED_TEST(EmulatedSurfaces, HitsAreOnTheirTriangle) {
  Draw draw(140);
  StokesSteps steps;
  for (int i = 0; i < 4000; ++i) {
    Corners corners;
    const auto h = drawHit(draw, steps, corners);
    expectUnit(h.face, "face");
    expectUnit(h.normal, "normal");
    EXPECT_TRUE(h.c.value >= 0 && h.c.value <= 1);
    // The origins are on the two sides of the plane, whatever the rounding of the hit point.
    const Vec n = toVec(h.face);
    const auto side = [&](const real3& origin) {
      return oracle::dot(n, oracle::along(toVec(origin), 1, corners.p[0], -1));
    };
    const Vec exact = oracle::unit(oracle::cross(oracle::along(corners.p[1], 1, corners.p[0], -1),
                                                 oracle::along(corners.p[2], 1, corners.p[0], -1)));
    if (std::abs(oracle::dot(exact, n)) < 1 - 1e-6L) continue;  // a sliver, whose normal is rounding error
    EXPECT_GT(side(steps.originAbove(h)), 0) << i;
    EXPECT_LT(side(steps.originBelow(h)), 0) << i;
  }
}

TYPED_TEST(EmulatedSurfaces, ScatteringIsPhysical) {
  Draw draw(141);
  StokesSteps steps;
  for (int i = 0; i < 2000 && !::testing::Test::HasFailure(); ++i) {
    Corners corners;
    auto h = drawHit(draw, steps, corners);
    const auto m = drawMaterial(draw);
    steps.extra = drawExtra(draw, m);
    expectScattering(steps.scatterPaint(h, m), "paint");
    expectScattering(steps.scatterMetal(h, m), "metal");
    expectScattering(steps.scatterPolarizingElement(h, m), "polarizing element");
    expectScattering(steps.scatterGlass(h, m), "glass");
    const auto pane = steps.scatterThinGlass(h, m);
    expectScattering(pane, "thin glass");
    EXPECT_LE(pane.reflection.rs.x.value + pane.transmission.rs.x.value, 1 + 8 * kUnit);
    EXPECT_LE(pane.reflection.rp.x.value + pane.transmission.rp.x.value, 1 + 8 * kUnit);
    expectShare(steps.mediumTransmittance(h), "medium");
    if (h.travelled.value == 0) {
      EXPECT_EQ(steps.mediumTransmittance(h).x.value, 1);
    }
    expectShare(steps.enteringRow(h, m, h.d, h.c).w, "entering");
    const auto facet = steps.sampleFacet(h, steps.visibleFacetsAt(h), number(draw, -0.7, 0.7), number(draw, -0.7, 0.7));
    expectUnit(facet.mirror, "facet");
    EXPECT_TRUE(facet.weight.value >= 0 && facet.weight.value * gpu::kFacets <= 1 + 8 * kUnit) << facet.weight.value;
    const emulated::PointLight light{numbers(draw, -3, 3), numbers(draw, 0, 10)};
    const auto sample = steps.sampleLight(h, m, light, h.normal, true, true);
    expectUnit(sample.direction, "light");
    for (const Real x : toVec(steps.lightIrradiance(h, light, sample))) EXPECT_TRUE(std::isfinite(x) && x >= 0);
    EXPECT_TRUE(std::isfinite(sample.lobe.value) && sample.lobe.value >= 0);
  }
}

// |(q, u, v)| <= w, but for the roundings of each bounce: 16 in the rotation and the product, of the weight at its
// start.
void expectImportance(const emulated::ImportanceVector& r, Real before, const char* what) {
  const Real size = std::sqrt(Real(r.q.value) * r.q.value + Real(r.u.value) * r.u.value + Real(r.v.value) * r.v.value);
  ASSERT_TRUE(std::isfinite(r.w.value) && std::isfinite(size)) << what;
  EXPECT_LE(size, r.w.value + 16 * kUnit * before) << what;
  EXPECT_LE(r.w.value, before * (1 + 8 * kUnit)) << what;
}

TYPED_TEST(EmulatedSurfaces, ImportancePathsStayPhysical) {
  Draw draw(142);
  emulated::ImportancePathSteps steps;
  for (int i = 0; i < 500 && !::testing::Test::HasFailure(); ++i) {
    emulated::ImportancePathSteps::CameraPath path;
    Real slack = 0;
    for (int bounce = 0; bounce < 8; ++bounce) {
      Corners corners;
      auto h = drawHit(draw, steps, corners);
      const auto m = drawMaterial(draw);
      steps.extra = drawExtra(draw, m);
      if (bounce == 0) {
        path.throughput =
            steps.startThroughput(h.d, vector(draw.direction()), real(0.5), real(0.3), real(0.4), real(0));
      } else {
        h.d = path.ray.d;
        h.c = emulated::clampUnit(-emulated::dot3(h.d, h.normal));
      }
      const Real before = std::max({path.throughput.r.w.value, path.throughput.g.w.value, path.throughput.b.w.value});
      steps.scaleThroughput(path.throughput, steps.mediumTransmittance(h));
      auto s = draw.below(2) == 0 ? steps.scatterMetal(h, m) : steps.scatterGlass(h, m);
      if (draw.below(5) == 0) s = steps.scatterPolarizingElement(h, m);
      steps.rotateToSurface(path.throughput, h.d, s.frameNormal);
      if (s.reflects) {
        steps.applyInterface(path.throughput, s.reflection, s.coloured);
        steps.followReflection(path, h, s, real(0));
      } else {
        steps.followTransmission(path, h, s, real(0));
      }
      const auto& c = path.throughput;
      slack += std::abs(before);
      expectImportance(c.r, slack, "red");
      expectImportance(steps.isSplit(c) ? c.g : c.r, slack, "green");
      expectImportance(steps.isSplit(c) ? c.b : c.r, slack, "blue");
      expectUnit(c.x, "frame", bounce + 1);
      for (const Real x : toVec(steps.unpolarizedContribution(c, m.albedo))) EXPECT_GE(x, -16 * kUnit * slack);
    }
  }
}

}  // namespace
}  // namespace malus::test
