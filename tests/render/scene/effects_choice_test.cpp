// --effects: the method that replaces another, the effects that are left out, and the warnings about them.
#include "render/scene/effects_choice.h"

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

using pack::MaterialKind;

// A flat mirror under a lamp; with `two`, a second one that faces it.
pack::Scene mirrors(bool two) {
  pack::Scene scene = test::emptyScene(6);
  test::addMaterial(scene, test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
  test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 1);
  if (two) test::addSquare(scene, 0, {0, 2, 0}, {0, -1, 0}, 1);
  scene.lights.push_back({{0, 1, 0}, {1, 1, 1}});
  scene.materials[0].highlightStrength = 1;
  scene.materials[0].highlightExponent = 10;
  test::look(scene, {0, 1, 3}, {0, 0, 0});
  return scene;
}
bake::ImageRequest intensityAt(std::uint32_t depth) {
  bake::ImageRequest request;
  request.depth = depth;
  return request;
}

TEST(EffectsChoice, AutoChoosesTheCheapestExactMethod) {
  const pack::Scene one = mirrors(false), two = mirrors(true);
  const auto chosen = [](const char* method, const pack::Scene& scene, const bake::ImageRequest& request) {
    return chooseEffects({"auto"}, method, scene, request).method;
  };
  // One mirror bounce of unpolarized light needs no polarization.
  EXPECT_EQ(chosen("stokes", one, intensityAt(6)), "fresnel");
  EXPECT_EQ(chosen("stokes-half", one, intensityAt(6)), "fresnel");
  EXPECT_EQ(chosen("importance", one, intensityAt(6)), "fresnel-iterative");
  EXPECT_FALSE(chooseEffects({"auto"}, "stokes", one, intensityAt(6)).why.empty());
  // Methods that are not exact are not replaced, and no method is with "all".
  for (const char* method : {"schlick", "fresnel", "sp", "sp-ratio", "sp-malus"})
    EXPECT_EQ(chosen(method, one, intensityAt(6)), method);
  EXPECT_EQ(chooseEffects({"all"}, "stokes", one, intensityAt(6)).method, "stokes");
  // Two facing mirrors need it, and circular light from four bounces on.
  EXPECT_EQ(chosen("stokes", two, intensityAt(6)), "stokes");
  EXPECT_EQ(chosen("importance", two, intensityAt(6)), "importance");
  EXPECT_EQ(chosen("stokes", two, intensityAt(3)), "stokes-linear");
  EXPECT_EQ(chosen("stokes", two, intensityAt(1)), "fresnel");
  // Requested Stokes vectors are recorded.
  bake::ImageRequest stokes = intensityAt(6);
  stokes.linearStokes = stokes.circularStokes = true;
  EXPECT_EQ(chosen("stokes", two, stokes), "stokes");
  EXPECT_EQ(chosen("stokes", one, stokes), "stokes-linear") << "one bounce of unpolarized light has no S3";
}

TEST(EffectsChoice, AListLeavesOutTheRestWithAWarning) {
  const pack::Scene two = mirrors(true);
  const EffectsChoice choice =
      chooseEffects({"metal", "point-lights", "shadows", "highlights"}, "stokes", two, intensityAt(3));
  EXPECT_EQ(choice.method, "fresnel");
  EXPECT_EQ(choice.off, std::vector<std::string>{"linear-polarization"});
  ASSERT_EQ(choice.warnings.size(), 1u);
  EXPECT_EQ(choice.warnings[0].effect, shaders::Effect::kLinearPolarization);
  EXPECT_NE(choice.warnings[0].text.find("linear-polarization"), std::string::npos);
  const EffectsChoice alias =
      chooseEffects({"conductor", "point-lights", "shadows", "highlights"}, "stokes", two, intensityAt(3));
  EXPECT_EQ(alias.off, choice.off) << "the earlier name of metal";
  const EffectsChoice dark = chooseEffects({"linear-polarization"}, "stokes", two, intensityAt(3));
  EXPECT_EQ(dark.off, (std::vector<std::string>{"metal", "point-lights", "shadows", "highlights"}));
  EXPECT_EQ(dark.warnings.size(), 4u);
  try {
    chooseEffects({"magic"}, "stokes", two, intensityAt(3));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("linear-polarization, "), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace malus::render
