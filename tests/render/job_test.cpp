// Jobs: the scene is copied only if an effect is removed from it.
#include "render/job.h"

#include <gtest/gtest.h>

#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

// Two facing mirrors of gold, a lamp between them, and a filter in the settings: the image needs all four effects that
// only the renderer can leave out.
pack::Pack mirrors() {
  pack::Pack pack;
  pack.scene = test::emptyScene(6);
  test::addMaterial(pack.scene, test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
  test::addSquare(pack.scene, 0, {0, 0, 0}, {0, 1, 0}, 1);
  test::addSquare(pack.scene, 0, {0, 2, 0}, {0, -1, 0}, 1);
  pack.scene.lights.push_back({{0, 1, 0}, {1, 1, 1}});
  pack.scene.materials[0].highlightStrength = 1;
  pack.scene.materials[0].highlightExponent = 10;
  test::look(pack.scene, {0, 1, 3}, {0, 0, 0});
  return pack;
}

JobSettings keep(const std::string& effects) {
  JobSettings settings;
  settings.method = "stokes";
  settings.analyser = {0.5, 0.5, 0, 0};
  settings.effects = effects;
  return settings;
}

TEST(Job, CopiesNoSceneIfNoEffectIsRemoved) {
  const pack::Pack pack = mirrors();
  const std::string inScene = "metal,point-lights,highlights,";
  for (const std::string& effects : {std::string("auto"), std::string("all"), inScene + "filter,shadows",
                                     inScene + "filter,linear-polarization,circular-polarization",
                                     inScene + "shadows,linear-polarization,circular-polarization"}) {
    const Job job(pack, keep(effects));
    EXPECT_EQ(&job.scene(), &pack.scene) << effects;
  }
  const Job unpolarized(pack, keep(inScene + "filter"));
  EXPECT_EQ(unpolarized.method(), "fresnel");
  EXPECT_FALSE(unpolarized.parameters().shadows);
  EXPECT_EQ(unpolarized.warnings().size(), 3u);
}

TEST(Job, RemovesEffectsFromACopy) {
  const pack::Pack pack = mirrors();
  const Job job(pack, keep("metal,point-lights,shadows,filter,linear-polarization,circular-polarization"));
  EXPECT_NE(&job.scene(), &pack.scene);
  EXPECT_EQ(job.scene().materials[0].highlightStrength, 0);
  EXPECT_EQ(pack.scene.materials[0].highlightStrength, 1);
}

}  // namespace
}  // namespace malus::render
