// FLIP against the authors' own program (flip-evaluator 1.7 from PyPI, evaluate(reference, test, "LDR",
// inputsRGB=False) with these images), and against consequences of its definition.
#include "render/compare/flip.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"

namespace malus::render {
namespace {

RenderResult pattern(unsigned a, unsigned b, unsigned c, unsigned k) {
  RenderResult p;
  p.width = 96;
  p.height = 64;
  for (unsigned y = 0; y < p.height; ++y)
    for (unsigned x = 0; x < p.width; ++x)
      for (unsigned channel = 0; channel < 3; ++channel)
        p.pixels.push_back(static_cast<float>((x * a + y * b + channel * c + x * y / k) % 64) / 64);
  return p;
}
RenderResult scaled(RenderResult p, float factor) {
  for (float& v : p.pixels) v = std::min(v * factor, 1.0f);
  return p;
}

TEST(Flip, EqualsTheAuthorsProgram) {
  const RenderResult reference = pattern(1, 2, 20, 37);
  // That program computes in single precision.
  constexpr double kRounding = 2e-5;
  EXPECT_NEAR(meanFlip(pattern(1, 2, 24, 37), reference, 0), 0.4636969566345215, kRounding);
  EXPECT_NEAR(meanFlip(pattern(5, 3, 7, 11), reference, 0), 0.7581363320350647, kRounding);
  EXPECT_NEAR(meanFlip(scaled(reference, 1.25f), reference, 0), 0.3669462203979492, kRounding);
  EXPECT_NEAR(meanFlip(scaled(reference, 0), reference, 0), 0.9798033833503723, kRounding);
  EXPECT_NEAR(meanFlip(pattern(1, 2, 24, 37), reference, 0, 20), 0.503057599067688, kRounding);
  EXPECT_NEAR(meanFlip(pattern(5, 3, 7, 11), reference, 0, 20), 0.8772826790809631, kRounding);
}

TEST(Flip, EqualImagesHaveNoDifference) {
  const RenderResult p = pattern(1, 2, 20, 37);
  EXPECT_EQ(meanFlip(p, p, 0), 0);
  // Values that the display clamps do not differ; with less exposure they are not clamped.
  EXPECT_EQ(meanFlip(scaled(p, 0), scaled(p, 0), 5), 0);
  RenderResult bright = p, brighter = p;
  for (float& v : bright.pixels) v = 2;
  for (float& v : brighter.pixels) v = 5;
  EXPECT_EQ(meanFlip(brighter, bright, 0), 0);
  EXPECT_GT(meanFlip(brighter, bright, -3), 0.1);
}

TEST(Flip, RefusesOtherSizes) {
  RenderResult p = pattern(1, 2, 20, 37);
  p.width = 48;
  EXPECT_THROW(meanFlip(p, pattern(1, 2, 20, 37), 0), Error);
}

}  // namespace
}  // namespace malus::render
