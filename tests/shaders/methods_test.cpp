// Every method's payload and light, and the methods against each other and against the Jones oracle.
#include "shaders/methods/methods.h"

#include <map>
#include <string_view>

#include "tests/shaders/chains.h"

namespace malus::test {
namespace {

using namespace malus::f32;
using oracle::Stokes4;
using oracle::Vec;

constexpr float kEps = std::numeric_limits<float>::epsilon();

template <class M>
class MethodTest : public ::testing::Test {};
struct MethodNames {
  template <class M>
  static std::string GetName(int) {
    std::string name = M::kName;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  }
};
#define MALUS_LIST(M) , M
template <class None, class... M>
struct List {
  using Types = ::testing::Types<M...>;
};
using Methods = List<void MALUS_FOR_EACH_METHOD(MALUS_LIST)>::Types;
TYPED_TEST_SUITE(MethodTest, Methods, MethodNames);

// Returns the payload of a camera ray from a source of this radiance at the end of the path.
template <class M>
typename M::Payload trace(const Path& path, real3 radiance = splat3(1)) {
  typename M::Payload p = M::payloadUnpolarized(radiance);
  for (std::size_t i = path.bounces.size(); i-- > 0;) {
    const Bounce& b = path.bounces[i];
    const real3 n = toReal3<F32>(b.n), d = toReal3<F32>(path.d[i]), next = toReal3<F32>(path.d[i + 1]);
    real3 n2 = splat3(0), k2 = n2;
    for (int j = 0; j < 3; ++j) {
      n2[j] = static_cast<float>(b.n2[static_cast<std::size_t>(j)].real());
      k2[j] = static_cast<float>(-b.n2[static_cast<std::size_t>(j)].imag());
    }
    const real c = clampUnit(-dot3(d, n)), n1 = static_cast<float>(b.n1);
    const auto f =
        b.metal ? M::conductorTerms(c, n1, n2, k2, n2 - splat3(n1)) : M::dielectricTerms(c, n1, n2.y, n2.y - n1);
    const real3 s = M::surfaceS(d, n);
    const auto arriving = M::lightAtSurface(p, next, s);
    p = M::payloadFromSurface(M::lightThroughInterface(b.transmits ? M::transmissionTerms(f) : f, arriving), d, s);
  }
  return p;
}
template <class M>
Stokes stokesAlong(const Path& path, real3 radiance = splat3(1)) {
  return M::payloadStokes(trace<M>(path, radiance), toReal3<F32>(path.d[0]));
}
Stokes4 stokes4(const Stokes& s, int colour) { return {s.s0[colour], s.s1[colour], s.s2[colour], s.s3[colour]}; }

// Largest difference of two methods' Stokes vectors over colours and components, the first `components` of them.
double difference(const Stokes& a, const Stokes& b, std::size_t components = 4) {
  double worst = 0;
  for (int colour = 0; colour < 3; ++colour)
    for (std::size_t j = 0; j < components; ++j)
      worst = std::max(worst, static_cast<double>(std::abs(stokes4(a, colour)[j] - stokes4(b, colour)[j])));
  return worst;
}

// Two mirrors, the second plane of incidence rotated by f from the first.
Path twoMirrors(const Bounce& first, const Bounce& second, double cosine, double degrees) {
  const oracle::Real f = degrees * std::acos(oracle::Real(-1)) / 180, c = cosine, s = std::sqrt(1 - c * c);
  Path path;
  path.d.push_back(oracle::unit({0.3L, 0.5L, -0.7L}));
  const Vec across = oracle::anyAcross(path.d[0]);
  extend(path, first, oracle::along(path.d[0], -c, across, s));
  const Vec d = path.d[1], inPlane = oracle::cross(oracle::cross(path.d[0], across), d);
  const Vec turned = oracle::along(inPlane, std::cos(f), oracle::cross(d, inPlane), std::sin(f));
  extend(path, second, oracle::along(d, -c, turned, s));
  return path;
}

// Error of packing to 16 bits, relative to S0; 0 for methods that do not pack.
template <class M>
constexpr double packingLoss() {
  return std::string_view(M::kName) == "stokes-half" ? 1.5e-3 : 0;
}

TEST(MethodsTest, PayloadSizesMatchTheDocument) {
  const std::map<std::string, std::size_t> bytes = {
      {"schlick", 12},  {"fresnel", 12},       {"sp", 36},     {"sp-cosine", 28},   {"sp-ratio", 20},
      {"sp-malus", 36}, {"stokes-linear", 36}, {"stokes", 48}, {"stokes-half", 24}, {"importance", 0}};
  std::size_t count = 0;
#define MALUS_SIZE(M)                                                                 \
  ++count;                                                                            \
  ASSERT_EQ(bytes.count(M::kName), 1u) << M::kName << " is not in the list of sizes"; \
  EXPECT_EQ(sizeof(M::Payload), bytes.at(M::kName)) << M::kName;
  MALUS_FOR_EACH_METHOD(MALUS_SIZE)
  EXPECT_GE(count, 8u);
}

// Words of many paths: a payload keeps all of their bits.
TYPED_TEST(MethodTest, PathWordIsSetAndRead) {
  typename TypeParam::Payload p = TypeParam::payloadUnpolarized(make3(5, 6, 7));
  word path = f32::pathStart(1, 2);
  for (word i = 0; i < 1000; ++i) {
    path = f32::joinWord(i * 7919u, f32::highHalf(i % 3 == 0   ? f32::reflectedPath(path)
                                                  : i % 3 == 1 ? f32::transmittedPath(path)
                                                               : f32::facetPath(path, i % 16)));
    TypeParam::payloadSetDepth(p, 7);
    TypeParam::payloadSetOriginDistance(p, 6.4e-4f);
    TypeParam::payloadSetPath(p, path);
    EXPECT_EQ(TypeParam::payloadPath(p), path);
    EXPECT_EQ(TypeParam::payloadDepth(p), 7);
    EXPECT_EQ(TypeParam::payloadOriginDistance(p), 6.4e-4f);
    EXPECT_TRUE(std::isnormal(f32::floatValue(path)));
  }
}

TYPED_TEST(MethodTest, DepthAndOriginDistanceAreSetAndRead) {
  EXPECT_EQ(sizeof(typename TypeParam::Payload), static_cast<std::size_t>(TypeParam::kPayloadBytes));
  typename TypeParam::Payload p = TypeParam::payloadUnpolarized(make3(5, 6, 7));
  for (const float depth : {0.0f, 1.0f, 31.0f}) {
    TypeParam::payloadSetDepth(p, depth);
    TypeParam::payloadSetOriginDistance(p, 6.4e-4f);
    EXPECT_EQ(TypeParam::payloadDepth(p), depth);
    EXPECT_EQ(TypeParam::payloadOriginDistance(p), 6.4e-4f);
  }
}

TYPED_TEST(MethodTest, SourcesAreUnpolarizedAndKeepTheirRadiance) {
  Draw draw(30);
  for (int i = 0; i < 100; ++i) {
    const real3 d = toReal3<F32>(draw.direction()), n = toReal3<F32>(draw.direction());
    const real3 radiance = make3(0.25f, 3, 0.5f);
    const auto p = TypeParam::payloadUnpolarized(radiance);
    EXPECT_LE(difference(TypeParam::payloadStokes(p, d), stokesUnpolarized(radiance)), 3 * packingLoss<TypeParam>());
    // Received by a surface and sent on unchanged, no light is lost.
    const real3 s = TypeParam::surfaceS(d, n);
    const auto sent = TypeParam::payloadFromSurface(TypeParam::lightAtSurface(p, d, s), d, s);
    EXPECT_LT(difference(TypeParam::payloadStokes(sent, d), stokesUnpolarized(radiance)),
              3 * (4 * kEps + 2 * packingLoss<TypeParam>()));
  }
}

TYPED_TEST(MethodTest, LightSumsAndLeaves) {
  Draw draw(31);
  const real3 d = toReal3<F32>(draw.direction()), n = toReal3<F32>(draw.direction());
  const auto sum = TypeParam::lightAdd(TypeParam::lightUnpolarized(make3(1, 2, 3)),
                                       TypeParam::lightUnpolarized(make3(0.5f, 0.25f, 1)));
  const Stokes s = TypeParam::payloadStokes(TypeParam::payloadFromSurface(sum, d, TypeParam::surfaceS(d, n)), d);
  EXPECT_LT(difference(s, stokesUnpolarized(make3(1.5f, 2.25f, 4))), 4 * (4 * kEps + packingLoss<TypeParam>()));
  // Light from below an interface has its mean transmittance.
  const auto f = TypeParam::dielectricTerms(0.3f, 1, 1.5f, 0.5f);
  const Stokes left = TypeParam::payloadStokes(
      TypeParam::payloadFromSurface(TypeParam::lightFromBelow(f, splat3(1)), d, TypeParam::surfaceS(d, n)), d);
  EXPECT_NEAR(left.s0.y, TypeParam::meanTransmittance(f).y, 2 * kEps + packingLoss<TypeParam>());
}

TYPED_TEST(MethodTest, OneBounceIsExact) {
  using M = TypeParam;
  Draw draw(32);
  const bool schlick = std::string(M::kName) == "schlick";
  const bool coarse = std::string(M::kName) == "sp-cosine" || std::string(M::kName) == "sp-ratio";
  const bool colourOnly = schlick || std::string(M::kName) == "fresnel";
  for (int i = 0; i < 1000; ++i) {
    const Path path = randomPath(draw, 1);
    const Stokes s = stokesAlong<M>(path);
    const Bounce& b = path.bounces[0];
    for (std::size_t colour = 0; colour < 3; ++colour) {
      const Stokes4 want = expectedStokes(path, colour), got = stokes4(s, static_cast<int>(colour));
      if (schlick) {
        const float r =
            schlickReflectance(static_cast<float>(path.cosine(0)), static_cast<float>(b.n1),
                               static_cast<float>(b.n2[colour].real()), static_cast<float>(-b.n2[colour].imag()));
        EXPECT_CLOSE(got[0], b.transmits ? 1 - r : r, 10 * kEps);
        continue;
      }
      // sp-ratio has one ratio for three colours: only their sum is exact.
      const bool mixed = std::string(M::kName) == "sp-ratio" && b.metal;
      if (!mixed) {
        EXPECT_CLOSE(got[0], want[0], 12 * kEps + packingLoss<M>());
      }
      if (colourOnly || mixed) continue;
      // The cosine of s keeps it to 3.5e-4 rad at worst.
      for (std::size_t j = 1; j < 4; ++j)
        EXPECT_CLOSE(got[j], want[j], (coarse ? 2 * 3.5e-4 : 20 * kEps) + packingLoss<M>());
    }
    const oracle::Real sum = expectedStokes(path, 0)[0] + expectedStokes(path, 1)[0] + expectedStokes(path, 2)[0];
    if (!schlick) {
      EXPECT_CLOSE(s.s0.x + s.s0.y + s.s0.z, sum, 30 * kEps + 3 * packingLoss<M>());
    }
  }
}

TYPED_TEST(MethodTest, NothingIsEverNanOrNegative) {
  using M = TypeParam;
  Draw draw(33);
  for (int i = 0; i < 3000; ++i) {
    // Any directions at all, related or not; exact axes and exact opposites among them.
    const auto direction = [&] {
      if (draw.below(4) != 0) return toReal3<F32>(draw.direction());
      real3 axis = splat3(0);
      axis[static_cast<int>(draw.below(3))] = draw.below(2) == 0 ? 1.0f : -1.0f;
      return axis;
    };
    const real3 d = direction(), next = direction(), n = draw.below(4) == 0 ? d * -1.0f : direction();
    const real c = draw.below(8) == 0 ? 0.0f : static_cast<float>(draw.unit());
    const auto f = draw.below(2) == 0 ? M::dielectricTerms(c, 1, 1.5f, 0.5f)
                                      : M::conductorTerms(c, 1, splat3(0.2f), splat3(3), splat3(-0.8f));
    auto p = M::payloadUnpolarized(draw.below(8) == 0 ? splat3(0) : make3(1, 0, 1e30f));
    for (int bounce = 0; bounce < 3; ++bounce)
      p = M::payloadFromSurface(M::lightThroughInterface(f, M::lightAtSurface(p, next, M::surfaceS(d, n))), d,
                                M::surfaceS(d, n));
    const Stokes s = M::payloadStokes(p, d);
    for (int colour = 0; colour < 3; ++colour) {
      for (const oracle::Real v : stokes4(s, colour)) ASSERT_TRUE(std::isfinite(static_cast<float>(v)));
      ASSERT_GE(s.s0[colour], 0);
    }
  }
}

TEST(MethodsTest, StokesEqualsJonesOverRandomChains) {
  Draw draw(34);
  Worst worst("stokes", double(kEps));
  for (int i = 0; i < 3000; ++i) {
    const Path path = randomPath(draw, 1 + draw.below(6));
    const Stokes s = stokesAlong<Method_stokes>(path);
    for (std::size_t colour = 0; colour < 3; ++colour) {
      const Stokes4 want = expectedStokes(path, colour), got = stokes4(s, static_cast<int>(colour));
      for (std::size_t j = 0; j < 4; ++j) worst.add((got[j] - want[j]) / unpolarizedShare(path, colour));
    }
  }
  // As in stokes_test.cpp; transmission is 1 - R here, whose error is that of 1.
  EXPECT_LT(worst.value(), 120);
}

TEST(MethodsTest, NearNormalIncidenceRotatesByRoundingOverTheSine) {
  // s is known to about eps / sine on each of the two rays, so polarized light is rotated by as much;
  // exactly along the axes nothing is lost.
  Draw draw(40);
  const auto worstError = [&](const Vec& d, const Vec& n) {
    Path path;
    path.d.push_back(d);
    extend(path, metalMirror(kMetals[0]), n);
    extend(path, glassMirror(), normalAt(draw, path.d.back(), 0.5547L));
    const Stokes s = stokesAlong<Method_stokes>(path);
    oracle::Real worst = 0;
    for (std::size_t j = 0; j < 4; ++j)
      worst = std::max(worst, std::abs(stokes4(s, 0)[j] - expectedStokes(path, 0)[j]) / unpolarizedShare(path, 0));
    return worst;
  };
  for (const double sine : {1e-4, 1e-3, 1e-2, 1e-1})
    for (int i = 0; i < 500; ++i) {
      const Vec d = draw.direction(), across = oracle::unit(oracle::cross(d, draw.direction()));
      EXPECT_LT(worstError(d, oracle::unit(oracle::along(d, -1, across, sine))), 12 * kEps / sine) << sine;
    }
  for (const Vec& axis : {Vec{1, 0, 0}, Vec{-1, 0, 0}, Vec{0, 1, 0}, Vec{0, -1, 0}, Vec{0, 0, 1}, Vec{0, 0, -1}})
    EXPECT_LT(worstError(axis, axis), 20 * kEps);
}

TEST(MethodsTest, PackedLightStaysPhysical) {
  // Fully polarized light of every brightness, packed and unpacked: never more than fully polarized.
  Draw draw(41);
  using M = Method_stokes_half;
  Worst worst("packing", 1);
  for (int i = 0; i < 20000; ++i) {
    const Vec p = draw.direction();
    const double size = std::pow(10.0, draw.between(-6, 9));
    Stokes s;
    s.s0 = splat3(static_cast<float>(size));
    s.s1 = s.s0 * static_cast<float>(p[0]);
    s.s2 = s.s0 * static_cast<float>(p[1]);
    s.s3 = s.s0 * static_cast<float>(p[2]);
    const Stokes4 got = stokes4(M::unpackStokes(M::packStokes(s)), 1);
    const oracle::Real length = std::sqrt(got[1] * got[1] + got[2] * got[2] + got[3] * got[3]);
    EXPECT_LE(length - got[0], 4 * kEps * got[0]);
    for (std::size_t j = 0; j < 4; ++j) worst.add((got[j] - stokes4(s, 1)[j]) / size);
  }
  EXPECT_LT(worst.value(), packingLoss<M>());
}

TEST(MethodsTest, StokesLinearIsExactForTwoBouncesAndWrongBehindTwoGoldMirrors) {
  Draw draw(35);
  for (int i = 0; i < 300; ++i) {
    // Circular light arises at the second metal; it matters to no intensity before a third surface.
    const Path path = randomPath(draw, 2);
    EXPECT_LT(difference(stokesAlong<Method_stokes>(path), stokesAlong<Method_stokes_linear>(path), 3), 20 * kEps);
  }
  Path path = twoMirrors(glassMirror(), metalMirror(kMetals[0]), 0.5, 45);
  for (const Bounce& kind : {metalMirror(kMetals[0]), glassMirror()}) {
    const Vec d = path.d.back(), before = path.bounces.back().n;
    const Vec plane = oracle::unit(oracle::along(before, 1, d, -oracle::dot(before, d)));
    const Vec turned = oracle::along(plane, std::sqrt(0.5L), oracle::cross(d, plane), std::sqrt(0.5L));
    extend(path, kind, oracle::along(d, -0.5L, turned, std::sqrt(0.75L)));
  }
  const Stokes full = stokesAlong<Method_stokes>(path), linear = stokesAlong<Method_stokes_linear>(path);
  EXPECT_CLOSE(full.s0.x, expectedStokes(path, 0)[0], 60 * kEps * unpolarizedShare(path, 0));
  EXPECT_GT(std::abs(linear.s0.x - full.s0.x), 0.02f * full.s0.x)
      << "glass, gold, gold, glass needs circular polarization";
}

TEST(MethodsTest, AbsoluteCosineIsExactForRightAngles) {
  // At 0 and 90 degrees |cos| and cos^2 are the same, and both are exact.
  for (const double degrees : {0.0, 90.0, 180.0, 270.0})
    for (const Bounce& second : {glassMirror(), metalMirror(kMetals[0])}) {
      const Path path = twoMirrors(metalMirror(kMetals[3]), second, 0.4, degrees);
      const Stokes exact = stokesAlong<Method_stokes_linear>(path);
      EXPECT_LT(difference(stokesAlong<Method_sp_malus>(path), exact, 3), 10 * kEps) << degrees;
      // The sine of the angle between is a rounding, not 0: |cos| takes it whole.
      EXPECT_LT(difference(stokesAlong<Method_sp>(path), exact, 3), 10 * kEps) << degrees;
    }
}

TEST(MethodsTest, MalusKeepsTheIntensityOfTwoBouncesAtEveryAngle) {
  // Powers without phase: S2 of the first surface's frame is lost, S0 after two bounces is not.
  for (int degrees = 0; degrees < 180; degrees += 15) {
    const Path path = twoMirrors(metalMirror(kMetals[3]), glassMirror(), 0.4, degrees);
    const Stokes malus = stokesAlong<Method_sp_malus>(path);
    for (int j = 0; j < 3; ++j)
      EXPECT_CLOSE(malus.s0[j], expectedStokes(path, static_cast<std::size_t>(j))[0], 12 * kEps) << degrees;
  }
}

TEST(MethodsTest, AbsoluteCosinesCreateLight) {
  // Light with I_s = I_p = 1/2, received at 45 degrees, becomes 1.41 times what it was.
  Draw draw(36);
  for (int i = 0; i < 50; ++i) {
    const Vec d = draw.direction(), s = oracle::anyAcross(d), p = oracle::cross(d, s);
    const real3 at45 = toReal3<F32>(oracle::along(s, std::sqrt(0.5L), p, std::sqrt(0.5L)));
    const auto light = Method_sp::lightUnpolarized(splat3(1));
    const auto sent = Method_sp::payloadFromSurface(light, toReal3<F32>(d), toReal3<F32>(s));
    const auto got = Method_sp::lightAtSurface(sent, toReal3<F32>(d), at45);
    EXPECT_CLOSE(got.s.x + got.p.x, std::sqrt(2.0L), 8 * kEps);
    const auto malus = Method_sp_malus::lightAtSurface(
        Method_sp_malus::payloadFromSurface(Method_sp_malus::lightUnpolarized(splat3(1)), toReal3<F32>(d),
                                            toReal3<F32>(s)),
        toReal3<F32>(d), at45);
    EXPECT_CLOSE(malus.s.x + malus.p.x, 1, 8 * kEps);
  }
}

TEST(MethodsTest, CosineKeepsTheDirectionButForItsRounding) {
  Draw draw(37);
  Worst worst("turn", 1);
  for (int i = 0; i < 20000; ++i) {
    const Vec d = draw.direction();
    const real3 along = toReal3<F32>(d), n = toReal3<F32>(normalAt(draw, d, 0.5L));
    const real3 s = sDirection(along, n);
    const real3 kept = Method_sp_cosine::sFromCosine(Method_sp_cosine::cosineFromS(along, s), along);
    worst.add(oracle::dot(oracle::cross(toVec(s), toVec(kept)), d));
  }
  EXPECT_LT(worst.value(), 7e-4);  // one step of a cosine at 1 is 3.5e-4 rad; s is off by another
  for (int i = 0; i < 2000; ++i) {
    const Path path = randomPath(draw, 3);
    const Stokes sp = stokesAlong<Method_sp>(path), cosine = stokesAlong<Method_sp_cosine>(path);
    EXPECT_LT(difference(sp, cosine, 1), 3 * 7e-4);
  }
}

TEST(MethodsTest, RatioIsExactWithoutColour) {
  Draw draw(38);
  for (int i = 0; i < 500; ++i) {
    Path path;
    path.d.push_back(draw.direction());
    for (int bounce = 0; bounce < 3; ++bounce)
      extend(path, glassMirror(), normalAt(draw, path.d.back(), draw.between(0.1, 0.9)));
    EXPECT_LT(difference(stokesAlong<Method_sp_ratio>(path), stokesAlong<Method_sp_cosine>(path), 1), 20 * kEps);
  }
}

TEST(MethodsTest, RatioKeepsLightWithoutS) {
  Draw draw(39);
  using M = Method_sp_ratio;
  for (int i = 0; i < 500; ++i) {
    const Vec d = draw.direction();
    const real3 along = toReal3<F32>(d), s = sDirection(along, toReal3<F32>(normalAt(draw, d, 0.5L)));
    M::SurfaceLight light = M::lightUnpolarized(splat3(0));
    light.p = make3(0.1f, 0.2f, 0.3f);
    const auto p = M::payloadFromSurface(light, along, s);
    EXPECT_EQ(p.ratio, 0);
    // Fully polarized along p, with different colours; no loss, as for `sp`.
    Method_sp::SurfaceLight same{light.s, light.p};
    const Stokes got = M::payloadStokes(p, along);
    const Stokes want = Method_sp::payloadStokes(Method_sp::payloadFromSurface(same, along, s), along);
    EXPECT_LT(difference(got, want), 0.3 * 2 * 7e-4);
    EXPECT_EQ(got.s0, light.p);
    // No light is lost at the next surface with the same s.
    const auto received = M::lightAtSurface(p, along, s);
    EXPECT_NEAR(received.p.y, 0.2f, 1e-5);
    EXPECT_NEAR(received.s.y, 0, 2e-4);
  }
  const auto dark = M::payloadFromSurface(M::lightUnpolarized(splat3(0)), make3(0, 0, 1), make3(0, 0, -1));
  EXPECT_EQ(M::payloadStokes(dark, make3(0, 0, 1)).s0, splat3(0));
}

TEST(MethodsTest, MissesCountAsHalfEach) {
  const real3 d = make3(0, 0.6f, 0.8f), s = make3(1, 0, 0);
  const auto expectHalves = [&](const auto& light) {
    EXPECT_EQ(light.s, splat3(0.5f));
    EXPECT_EQ(light.p, splat3(0.5f));
  };
  expectHalves(Method_sp::lightAtSurface(Method_sp::payloadUnpolarized(splat3(1)), d, s));
  expectHalves(Method_sp_malus::lightAtSurface(Method_sp_malus::payloadUnpolarized(splat3(1)), d, s));
  expectHalves(Method_sp_cosine::lightAtSurface(Method_sp_cosine::payloadUnpolarized(splat3(1)), d, s));
  expectHalves(Method_sp_ratio::lightAtSurface(Method_sp_ratio::payloadUnpolarized(splat3(1)), d, s));
}

}  // namespace
}  // namespace malus::test
