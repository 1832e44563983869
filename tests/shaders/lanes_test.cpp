// Every shared file compiles on a two-lane type and gives in each lane the scalar build's result, bit by bit: both do
// the same operations in the same order. The lanes get unrelated inputs, so that they differ at every select.
#include "tests/shaders/lanes.h"

#include <cstring>
#include <tuple>
#include <type_traits>

#include "shaders/methods/methods.h"
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

MALUS_OPTICS(L32, lanes32, lanes32::real, "float")
MALUS_OPTICS(L64, lanes64, lanes64::real, "double")

template <class S>
S drawScalar(Draw& draw) {
  switch (draw.below(12)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return S(0.5);
    default:
      return static_cast<S>(draw.unit());
  }
}
template <class S, class T>
T drawAny(Draw& draw) {
  if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::uint32_t>) {
    return static_cast<T>(draw.below(4096));
  } else if constexpr (std::is_same_v<T, bool>) {
    return draw.below(2) == 0;
  } else {
    // Structs of the shared files are scalars in a row. Those of three may be directions.
    static_assert(sizeof(T) % sizeof(S) == 0);
    S values[sizeof(T) / sizeof(S)];
    for (S& v : values) v = drawScalar<S>(draw);
    if (sizeof(T) == 3 * sizeof(S)) {
      const oracle::Vec d = draw.direction();
      for (std::size_t i = 0; i < 3; ++i) values[i] = static_cast<S>(d[i]);
    }
    T result;
    std::memcpy(&result, values, sizeof(T));
    return result;
  }
}
template <class To, class S, class From>
To packed(const From& a, const From& b) {
  if constexpr (std::is_same_v<To, From>) {
    return a;
  } else if constexpr (std::is_same_v<From, bool> || std::is_same_v<From, std::uint32_t>) {
    return {a, b};
  } else {
    static_assert(sizeof(To) == 2 * sizeof(From));
    constexpr std::size_t kCount = sizeof(From) / sizeof(S);
    S first[kCount], second[kCount], both[2 * kCount];
    std::memcpy(first, &a, sizeof(a));
    std::memcpy(second, &b, sizeof(b));
    for (std::size_t i = 0; i < kCount; ++i) {
      both[2 * i] = first[i];
      both[2 * i + 1] = second[i];
    }
    To result;
    std::memcpy(&result, both, sizeof(result));
    return result;
  }
}
template <class S, class Lane, class Scalar>
void expectSame(const Lane& lane, const Scalar& a, const Scalar& b, const char* name) {
  const Lane expected = packed<Lane, S>(a, b);
  constexpr std::size_t kCount = sizeof(Lane) / sizeof(S);
  S got[kCount], want[kCount];
  std::memcpy(got, &lane, sizeof(lane));
  std::memcpy(want, &expected, sizeof(expected));
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_TRUE(got[i] == want[i] || (std::isnan(got[i]) && std::isnan(want[i])))
        << name << " number " << i / 2 << " of lane " << i % 2 << ": " << got[i] << " instead of " << want[i];
}
// Draws arguments for both lanes and compares the results of the scalar and of the lane build.
template <class S, class Result, class LaneResult, class... A, class... LaneA>
void expectSameResults(Result (&scalar)(A...), LaneResult (&lane)(LaneA...), const char* name) {
  Draw draw(50);
  for (int i = 0; i < 400; ++i) {
    std::tuple<A...> first{drawAny<S, A>(draw)...}, second{drawAny<S, A>(draw)...};
    const auto sameInts = [](auto& a, auto& b) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(a)>, int>) b = a;
    };
    const auto run = [&]<std::size_t... I>(std::index_sequence<I...>) {
      (sameInts(std::get<I>(first), std::get<I>(second)), ...);
      const LaneResult got = lane(packed<LaneA, S>(std::get<I>(first), std::get<I>(second))...);
      expectSame<S>(got, scalar(std::get<I>(first)...), scalar(std::get<I>(second)...), name);
    };
    run(std::index_sequence_for<A...>());
    if (::testing::Test::HasFatalFailure()) return;
  }
}
#define MALUS_SAME(name) expectSameResults<S>(F::name, L::name, #name);

template <class S, class F, class L>
void compareOptics() {
  MALUS_SAME(make3)
  MALUS_SAME(splat3)
  MALUS_SAME(dot3)
  MALUS_SAME(cross3)
  MALUS_SAME(select3)
  MALUS_SAME(max3)
  MALUS_SAME(normalize3)
  MALUS_SAME(signNotZero)
  MALUS_SAME(square)
  MALUS_SAME(clampUnit)
  MALUS_SAME(powInteger)
  MALUS_SAME(dielectricReflectance)
  MALUS_SAME(dielectricTransmittance)
  MALUS_SAME(conductorReflectance)
  MALUS_SAME(conductorReflectanceWith)
  MALUS_SAME(schlickReflectanceWith)
  MALUS_SAME(schlickReflectance)
  MALUS_SAME(mirrorDirection)
  MALUS_SAME(refractedDirection)
  MALUS_SAME(stokesUnpolarized)
  MALUS_SAME(stokesAdd)
  MALUS_SAME(rotateStokes)
  MALUS_SAME(stokesInterface)
  MALUS_SAME(lambertRadiance)
  MALUS_SAME(phongLobe)
  MALUS_SAME(directionFromOctahedral)
  MALUS_SAME(irradiancePolynomial)
  MALUS_SAME(shadingNormal)
  MALUS_SAME(hitPointError)
  MALUS_SAME(intersectionError)
  MALUS_SAME(rayOrigin)
  MALUS_SAME(cameraDirection)
  MALUS_SAME(cameraSampleDirection)
  MALUS_SAME(trianglePoint)
  MALUS_SAME(pointOnRay)
  MALUS_SAME(analysed)
  // Those that write into their parameters, and the one that returns masks.
  using real = S;
  using real3 = typename F::real3;
  using Lane = typename L::real;
  using Lane3 = typename L::real3;
  Draw draw(51);
  for (int i = 0; i < 400; ++i) {
    const auto vector = [&] { return drawAny<S, real3>(draw); };
    const real3 a0 = vector(), a1 = vector(), n0 = vector(), n1 = vector();
    const Lane3 a = packed<Lane3, S>(a0, a1), n = packed<Lane3, S>(n0, n1);
    real3 x0, x1, y0, y1;
    Lane3 x, y;
    F::canonicalFrame(a0, x0, y0);
    F::canonicalFrame(a1, x1, y1);
    L::canonicalFrame(a, x, y);
    expectSame<S>(x, x0, x1, "canonicalFrame x");
    expectSame<S>(y, y0, y1, "canonicalFrame y");
    real u0, v0, u1, v1;
    Lane u, v;
    F::frameRotation(n0, x0, y0, u0, v0);
    F::frameRotation(n1, x1, y1, u1, v1);
    L::frameRotation(n, x, y, u, v);
    expectSame<S>(u, u0, u1, "frameRotation cos");
    expectSame<S>(v, v0, v1, "frameRotation sin");
    expectSame<S>(L::sDirection(a, n), F::sDirection(a0, n0), F::sDirection(a1, n1), "sDirection");
    F::octahedralFromDirection(a0, u0, v0);
    F::octahedralFromDirection(a1, u1, v1);
    L::octahedralFromDirection(a, u, v);
    expectSame<S>(u, u0, u1, "octahedral u");
    expectSame<S>(v, v0, v1, "octahedral v");
    F::cameraFrameRotation(a0, n0, u0, v0);
    F::cameraFrameRotation(a1, n1, u1, v1);
    L::cameraFrameRotation(a, n, u, v);
    expectSame<S>(u, u0, u1, "cameraFrameRotation cos");
    expectSame<S>(v, v0, v1, "cameraFrameRotation sin");
    const real c0 = drawScalar<S>(draw), c1 = drawScalar<S>(draw);
    const auto r0 = F::refractionTerms(c0, S(1.5), 1), r1 = F::refractionTerms(c1, S(1.5), 1);
    const auto r = L::refractionTerms({c0, c1}, Lane(1.5), Lane(1));
    expectSame<S>(r.t, r0.t, r1.t, "t");
    expectSame<S>(r.tau, r0.tau, r1.tau, "tau");
    EXPECT_TRUE(r.total.lane[0] == r0.total && r.total.lane[1] == r1.total);
    EXPECT_TRUE(r.matched.lane[0] == r0.matched && r.matched.lane[1] == r1.matched);
  }
  EXPECT_EQ(L::kPi.lane[1], F::kPi);
}

template <class F, class L>
void compareMethod() {
  SCOPED_TRACE(F::kName);
  using S = float;
  MALUS_SAME(payloadDepth)
  MALUS_SAME(payloadUnpolarized)
  MALUS_SAME(payloadStokes)
  MALUS_SAME(payloadFromSurface)
  MALUS_SAME(surfaceS)
  MALUS_SAME(lightUnpolarized)
  MALUS_SAME(lightAdd)
  MALUS_SAME(lightAtSurface)
  MALUS_SAME(lightThroughInterface)
  MALUS_SAME(lightFromBelow)
  MALUS_SAME(meanTransmittance)
  MALUS_SAME(dielectricTerms)
  MALUS_SAME(conductorTerms)
  MALUS_SAME(transmissionTerms)
  auto p = L::payloadUnpolarized(lanes32::splat3({1, 2}));
  L::payloadSetDepth(p, {3, 4});
  L::payloadSetOriginDistance(p, {0.5, 0.125});
  EXPECT_EQ(L::payloadDepth(p).lane[1], 4);
  EXPECT_EQ(L::payloadOriginDistance(p).lane[1], 0.125);
}

TEST(LanesTest, OpticsInFloat) { compareOptics<float, F32, L32>(); }
TEST(LanesTest, OpticsInDouble) { compareOptics<double, F64, L64>(); }
TEST(LanesTest, EveryMethod) {
#define MALUS_COMPARE(M) compareMethod<f32::M, lanes32::M>();
  MALUS_FOR_EACH_METHOD(MALUS_COMPARE)
}

}  // namespace
}  // namespace malus::test
