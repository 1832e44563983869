// The images of an ablation, and its conclusions.
#include <algorithm>

#include <gtest/gtest.h>

#include "render/ablation/advice.h"
#include "render/ablation/variants.h"
#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

pack::Scene mirrors(std::uint32_t depth) {
  pack::Scene scene = test::emptyScene(depth);
  test::addMaterial(scene, test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
  test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 1);
  test::addSquare(scene, 0, {0, 2, 0}, {0, -1, 0}, 1);
  scene.lights.push_back({{0, 1, 0}, {1, 1, 1}});
  scene.materials[0].highlightStrength = 1;
  scene.materials[0].highlightExponent = 10;
  test::look(scene, {0, 1, 3}, {0, 0, 0});
  return scene;
}

const Variant* named(const std::vector<Variant>& variants, const std::string& name) {
  const auto found = std::find_if(variants.begin(), variants.end(), [&](const Variant& v) { return v.name == name; });
  return found == variants.end() ? nullptr : &*found;
}

TEST(AblationVariants, LeaveOutOneThingEach) {
  const pack::Scene scene = mirrors(4);
  const std::vector<Variant> variants = ablationVariants(scene, defaultParameters(scene));
  EXPECT_EQ(variants.front().kind, VariantKind::complete);
  EXPECT_EQ(variants.front().method, "stokes");
  EXPECT_EQ(variants.front().scene, nullptr);
  ASSERT_NE(named(variants, "linear-polarization"), nullptr);
  EXPECT_EQ(named(variants, "linear-polarization")->method, "fresnel");
  ASSERT_NE(named(variants, "circular-polarization"), nullptr);
  EXPECT_EQ(named(variants, "circular-polarization")->method, "stokes-linear");
  ASSERT_NE(named(variants, "shadows"), nullptr);
  EXPECT_FALSE(named(variants, "shadows")->parameters.shadows);
  EXPECT_EQ(named(variants, "shadows")->scene, nullptr);
  ASSERT_NE(named(variants, "highlights"), nullptr);
  ASSERT_NE(named(variants, "highlights")->scene, nullptr);
  EXPECT_EQ(named(variants, "highlights")->scene->materials[0].highlightStrength, 0);
  EXPECT_EQ(named(variants, "glass"), nullptr);
  EXPECT_EQ(named(variants, "tir"), nullptr);
}

TEST(AblationVariants, MeasureEveryBounceOfAShortPath) {
  const pack::Scene scene = mirrors(4);
  std::vector<std::uint32_t> depths;
  for (const Variant& variant : ablationVariants(scene, defaultParameters(scene)))
    if (variant.kind == VariantKind::depth) depths.push_back(variant.parameters.depth);
  EXPECT_EQ(depths, (std::vector<std::uint32_t>{3, 2, 1, 0}));
}

TEST(AblationVariants, MeasureFewBouncesOfALongPath) {
  const pack::Scene scene = mirrors(255);
  std::vector<std::uint32_t> depths;
  for (const Variant& variant : ablationVariants(scene, defaultParameters(scene)))
    if (variant.kind == VariantKind::depth) depths.push_back(variant.parameters.depth);
  ASSERT_LE(depths.size(), kMostBounces);
  EXPECT_EQ(depths.front(), 254u);
  EXPECT_TRUE(std::is_sorted(depths.rbegin(), depths.rend()));
  EXPECT_TRUE(std::adjacent_find(depths.begin(), depths.end()) == depths.end());
}

// A diffuse floor below a lamp, which lights it.
pack::Scene lamp() {
  pack::Scene scene = test::emptyScene(1);
  test::addMaterial(scene, test::dielectric(pack::MaterialKind::lambert, 1, 0.5));
  test::addMaterial(scene, test::emitter({1, 1, 1}));
  scene.materials[1].illuminates = true;
  test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 1);
  test::addSquare(scene, 1, {0, 2, 0}, {0, -1, 0}, 1);
  test::look(scene, {0, 1, 3}, {0, 0, 0});
  return scene;
}

TEST(AblationVariants, HalveTheLightSamples) {
  const pack::Scene scene = lamp();
  RenderParameters parameters = defaultParameters(scene);
  parameters.lightSamples = 8;
  std::vector<std::uint32_t> samples;
  for (const Variant& variant : ablationVariants(scene, parameters))
    if (variant.kind == VariantKind::samples) samples.push_back(variant.parameters.lightSamples);
  EXPECT_EQ(samples, (std::vector<std::uint32_t>{4, 2, 1}));
  ASSERT_NE(named(ablationVariants(scene, parameters), "2 of 8 light samples"), nullptr);
  for (const Variant& variant : ablationVariants(mirrors(1), parameters)) EXPECT_NE(variant.kind, VariantKind::samples);
}

AblationRow timedRow(double relRms, double share, double ratio, std::size_t rounds) {
  AblationRow row;
  row.kind = VariantKind::effect;
  row.name = "shadows";
  row.error.relRms = relRms;
  row.error.maxAbs = relRms;
  row.error.shareOver1Percent = share;
  row.samplesMs.assign(rounds, 1.0);
  row.ratioToComplete = {ratio, ratio, ratio};
  row.differs = rounds >= 6 && ratio != 1;
  return row;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(Advice, LeavesOutWhatIsInvisibleAndCostsTime) {
  const AblationRow row = timedRow(2e-6, 0, 0.91, 7);
  EXPECT_TRUE(has(advice(row), "leave out")) << advice(row);
  EXPECT_TRUE(has(advice(row), "9 %")) << advice(row);
}

TEST(Advice, KeepsWhatIsSeen) {
  const AblationRow row = timedRow(0.05, 0.999, 0.5, 7);
  EXPECT_TRUE(has(advice(row), "keep")) << advice(row);
  EXPECT_TRUE(has(advice(row), "100 %")) << advice(row);
}

TEST(Advice, GainsNothingByLeavingOutWhatIsFree) {
  const AblationRow row = timedRow(0, 0, 1, 7);
  EXPECT_TRUE(has(advice(row), "gains nothing")) << advice(row);
}

TEST(Advice, AsksForMoreRounds) {
  const AblationRow row = timedRow(0, 0, 0.5, 3);
  EXPECT_TRUE(has(advice(row), "6 rounds")) << advice(row);
}

TEST(Advice, CostPerErrorPrefersMuchTimeForLittleError) {
  const ImageError small{0, 0, 1e-4, 0, 0, 1}, large{0, 0, 1e-1, 0, 0, 1}, none{0, 0, 0, 0, 0, 1};
  EXPECT_GT(costPerError(0.1, small), costPerError(0.1, large));
  EXPECT_GT(costPerError(0.2, large), costPerError(0.1, large));
  EXPECT_GT(costPerError(0.1, none), costPerError(0.1, small));
  EXPECT_LT(costPerError(-0.1, small), 0);
}

}  // namespace
}  // namespace malus::render
