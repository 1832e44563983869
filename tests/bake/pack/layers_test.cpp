// Specular factors, clear coats and tinted glass in packs.
#include "tests/bake/pack/corrupt_pack.h"

namespace malus::pack {
namespace {

using bake::test::contains;

Scene layeredScene() {
  Scene scene = bake::test::smallScene();
  scene.materials[0].transmittanceParallel = {1, 0.5, 0.25};
  scene.materials[0].specularFactor = 0.75;
  scene.materials[1].clearCoat = {1.6, 0.5};
  return scene;
}

TEST(LayersInPacks, RoundTrip) {
  const Scene scene = layeredScene(), s = parse(serialize(scene, {}).bytes, "test").scene;
  ASSERT_EQ(s.materials.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(s.materials[i].specularFactor, scene.materials[i].specularFactor);
    EXPECT_EQ(s.materials[i].clearCoat.eta, scene.materials[i].clearCoat.eta);
    EXPECT_EQ(s.materials[i].clearCoat.factor, scene.materials[i].clearCoat.factor);
    EXPECT_EQ(s.materials[i].transmittanceParallel, scene.materials[i].transmittanceParallel);
  }
}

// Packs without the layers keep their bytes: version 1 of the section suffices for tinted glass.
TEST(LayersInPacks, NeedTheirVersionOfTheSection) {
  const auto version = [](const Scene& scene) {
    for (const test::RawSection& section : test::takenApart(serialize(scene, {}).bytes))
      if (section.id == kSurfaces) return section.version;
    return 0u;
  };
  Scene scene = bake::test::smallScene();
  EXPECT_EQ(version(scene), 0u);
  scene.materials[0].transmittanceParallel = glm::dvec3(0.5);
  EXPECT_EQ(version(scene), 1u);
  EXPECT_EQ(version(layeredScene()), 4u);
}

TEST(LayersInPacks, ErrorsNameTheField) {
  Scene scene = layeredScene();
  const auto error = [&] { return parseError(serialize(scene, {}).bytes); };
  EXPECT_EQ(error(), "");
  scene.materials[1].coating.thicknessNm = 100;
  EXPECT_TRUE(contains(error(), "clearCoat")) << error();
  scene = layeredScene();
  scene.materials[0].specularFactor = 1.5;
  EXPECT_TRUE(contains(error(), "specularFactor")) << error();
  scene = layeredScene();
  scene.materials[1].clearCoat.eta = 0;
  EXPECT_TRUE(contains(error(), "clearCoat.eta")) << error();
  scene = layeredScene();
  scene.materials[2].clearCoat.factor = 0.5;  // of an emitter
  EXPECT_TRUE(contains(error(), "clearCoat.factor")) << error();
}

}  // namespace
}  // namespace malus::pack
