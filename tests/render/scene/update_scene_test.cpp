// A scene that changes below its renderer gives the image of a new renderer.
#include <gtest/gtest.h>

#include "render/make_renderer.h"
#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

// A metal, paint, glass and an area light, seen from above.
pack::Scene room() {
  pack::Scene scene = test::emptyScene(5);
  scene.width = 24;
  scene.height = 18;
  scene.camera.verticalFovDegrees = 60;
  const std::uint32_t gold = test::addMaterial(scene, test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9})),
                      paint = test::addMaterial(scene, test::dielectric(pack::MaterialKind::paint, 1.5, 0.6)),
                      pane = test::addMaterial(scene, test::dielectric(pack::MaterialKind::thinGlass, 1.5)),
                      lamp = test::addMaterial(scene, test::emitter(glm::dvec3(4)));
  scene.materials[lamp].illuminates = true;
  test::addSquare(scene, paint, {0, 0, 0}, {0, 0, 1}, 3);
  test::addSquare(scene, gold, {1.5, 0, 1}, {-1, 0, 0.5}, 1);
  test::addSquare(scene, pane, {-1, 0, 1}, {0.3, 0, 1}, 0.7);
  test::addSquare(scene, lamp, {0, 2, 3}, {0, -0.5, -1}, 0.4);
  scene.lights.push_back({{-2, -1, 3}, {5, 6, 7}});
  bake::bakeConstantEnvironment({0.2, 0.3, 0.4}, scene.environment);
  scene.environment.ambientIrradiance = 1;
  test::look(scene, {0, -1, 5}, {0, 0, 0});
  return scene;
}

void change(pack::Scene& scene) {
  scene.materials[0].eta = {0.3, 0.4, 2};
  scene.materials[0].k = {4, 3, 2.5};
  scene.materials[0].roughness = 0.2;
  scene.materials[1].albedo = {0.2, 0.7, 0.1};
  scene.materials[1].coating = {glm::dvec3(1.8), 140};
  scene.materials[2].eta = glm::dvec3(1.8);
  scene.materials[3].radiance = {1, 9, 2};
  scene.wavelengthsNm = {650, 540, 440};
  scene.lights[0].intensity = {9, 1, 1};
  scene.lights.push_back({{2, 2, 4}, {3, 3, 3}});
  bake::bakeConstantEnvironment({0.5, 0.1, 0.1}, scene.environment);
}

class UpdateScene : public testing::TestWithParam<Backend> {
 protected:
  static std::vector<float> render(Renderer& renderer, const pack::Scene& scene) {
    RenderParameters parameters = defaultParameters(scene);
    return renderer.render("stokes", parameters).pixels;
  }
  static std::vector<float> renderAnew(const pack::Scene& scene) {
    return render(*makeRenderer(GetParam(), scene, {"", 1}), scene);
  }
};

TEST_P(UpdateScene, TakesOverMaterialsLightsAndEnvironment) {
  pack::Scene scene = room();
  const auto renderer = makeRenderer(GetParam(), scene, {"", 1});
  const std::vector<float> first = render(*renderer, scene);
  change(scene);
  ASSERT_TRUE(renderer->updateScene());
  const std::vector<float> second = render(*renderer, scene);
  EXPECT_NE(first, second);
  EXPECT_EQ(second, renderAnew(scene));
  // And back, with fewer lights.
  scene = room();
  ASSERT_TRUE(renderer->updateScene());
  EXPECT_EQ(render(*renderer, scene), first);
}

TEST_P(UpdateScene, CamerasNeedNoCall) {
  pack::Scene scene = room();
  const auto renderer = makeRenderer(GetParam(), scene, {"", 1});
  const std::vector<float> first = render(*renderer, scene);
  test::look(scene, {1, -2, 4}, {0.5, 0, 0.5});
  scene.camera.middleX = 0.1;
  const std::vector<float> second = render(*renderer, scene);
  EXPECT_NE(first, second);
  EXPECT_EQ(second, renderAnew(scene));
}

// A surface between equal media is not in the acceleration structure.
TEST_P(UpdateScene, SurfacesThatVanishNeedANewRenderer) {
  pack::Scene scene = room();
  const auto renderer = makeRenderer(GetParam(), scene, {"", 1});
  scene.materials[2].eta = glm::dvec3(1);
  EXPECT_FALSE(renderer->updateScene());
}

INSTANTIATE_TEST_SUITE_P(, UpdateScene, testing::Values(Backend::embree, Backend::reference),
                         [](const auto& backend) { return std::string(backendInfo(backend.param).name); });

}  // namespace
}  // namespace malus::render
