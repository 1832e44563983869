// The traits in shaders/methods.def against the methods' own functions.
#include "render/scene/methods.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "shaders/methods/methods.h"

namespace malus::render {
namespace {

// Light from a glass mirror at Brewster's angle, hence linearly polarized, meets a metal mirror whose plane of
// incidence is at 45 degrees to that of the glass: the reflected light has linear and circular components.
template <class M>
f32::Stokes throughGlassAndMetal() {
  using f32::real3;
  const real3 toMetal(0, 0, -1), metalNormal(0.5f, 0.5f, std::sqrt(0.5f));
  const real3 toGlass = f32::mirrorDirection(toMetal, metalNormal, metalNormal.z);
  const real3 side = glm::normalize(real3(0, 0, 1) + glm::cross(toGlass, real3(0, 0, 1)));
  const real3 glassNormal = glm::normalize(side * 1.5f - toGlass);
  const auto glass = M::dielectricTerms(-glm::dot(toGlass, glassNormal), 1.0f, 1.5f, 0.5f);
  const auto metal = M::conductorTerms(metalNormal.z, 1.0f, real3(0.2f), real3(3.0f), real3(-0.8f));
  const real3 glassS = M::surfaceS(toGlass, glassNormal), metalS = M::surfaceS(toMetal, metalNormal);
  const auto fromGlass =
      M::payloadFromSurface(M::lightThroughInterface(glass, M::lightUnpolarized(real3(1))), toGlass, glassS);
  const auto fromMetal = M::payloadFromSurface(
      M::lightThroughInterface(metal, M::lightAtSurface(fromGlass, toGlass, metalS)), toMetal, metalS);
  return M::payloadStokes(fromMetal, toMetal);
}

template <class M>
class CarriedPolarizationTest : public ::testing::Test {};
#define MALUS_LIST(M) , f32::M
template <class None, class... M>
struct List {
  using Types = ::testing::Types<M...>;
};
using Recursive = List<void MALUS_FOR_EACH_METHOD(MALUS_LIST)>::Types;
TYPED_TEST_SUITE(CarriedPolarizationTest, Recursive);

TYPED_TEST(CarriedPolarizationTest, IsWhatTheRowStates) {
  const MethodInfo& method = methodNamed(TypeParam::kName);
  const f32::Stokes s = throughGlassAndMetal<TypeParam>();
  const auto present = [&](const f32::real3& v) { return std::abs(v.x) > 1e-2f * s.s0.x; };
  EXPECT_EQ(method.carriesLinear(), present(s.s1) || present(s.s2)) << method.name;
  EXPECT_EQ(method.carriesCircular(), present(s.s3)) << method.name;
}

TEST(Methods, IterativeRowsStateWhatTheyCarry) {
  EXPECT_TRUE(methodNamed("importance").carriesCircular());
  EXPECT_FALSE(methodNamed("fresnel-iterative").carriesLinear());
  EXPECT_FALSE(methodNamed("schlick-iterative").carriesLinear());
}

TEST(Methods, ReplacementsCarryNoMoreThanIsNeeded) {
  for (const MethodInfo& m : methods()) {
    const MethodInfo &linear = methodNamed(m.withoutLinear), &circular = methodNamed(m.withoutCircular);
    EXPECT_FALSE(linear.carriesLinear()) << m.name;
    EXPECT_EQ(circular.carriesLinear(), m.carriesLinear()) << m.name;
    EXPECT_EQ(linear.isIterative, m.isIterative) << m.name;
    EXPECT_EQ(circular.isIterative, m.isIterative) << m.name;
    EXPECT_LE(linear.payloadBytes, m.payloadBytes) << m.name;
    EXPECT_LE(circular.payloadBytes, m.payloadBytes) << m.name;
  }
}

TEST(Methods, BaselineAndCompleteMethods) {
  EXPECT_EQ(baselineMethod().name, "schlick");
  EXPECT_EQ(completeRecursiveMethod().name, "stokes");
  for (const MethodInfo& m : methods())
    EXPECT_EQ(m.isComplete(), m.name == "stokes" || m.name == "importance") << m.name;
}

TEST(Methods, EarlierNamesAreAliases) {
  EXPECT_EQ(methodNamed("schlick-loop").name, "schlick-iterative");
  EXPECT_EQ(methodNamed("fresnel-loop").name, "fresnel-iterative");
  EXPECT_THROW(methodNamed(""), Error);
  EXPECT_THROW(methodNamed("magic"), Error);
}

}  // namespace
}  // namespace malus::render
