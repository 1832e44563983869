// The scenes of scenes/effects: renderers agree, each scene needs its effect, and compiling fewer effects or ending
// faint paths changes images within stated bounds.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "bake/bake.h"
#include "bake/effects/effects.h"
#include "bake/scene_file/scene_file.h"
#include "render/compare/image_error.h"
#include "render/scene/effects_choice.h"
#include "tests/render/render_everywhere.h"

namespace malus {
namespace {

namespace fs = std::filesystem;
using pack::Material;
using render::RenderParameters;
using render::RenderResult;

// The scenes, and the effect that each is there for.
struct EffectScene {
  const char* effect;
  double leastChange;  // relative RMS error of the image without the effect
};
const std::map<std::string, EffectScene>& scenes() {
  static const std::map<std::string, EffectScene> kScenes = {
      {"textures", {"textures", 0.1}},
      {"absorption", {"absorption", 0.1}},
      {"polarized-sky", {"sky", 0.02}},
      {"display", {"polarized-emitters", 0.02}},
      {"polarizing-sheets", {"polarizing-elements", 0.1}},
      {"coating", {"coatings", 0.1}},
      {"rough-reflection", {"roughness", 0.05}},
      {"thin-glass", {"thin-glass", 0.02}},
  };
  return kScenes;
}

const pack::Scene& sceneNamed(const std::string& name) {
  static std::map<std::string, pack::Scene> baked;
  if (const auto found = baked.find(name); found != baked.end()) return found->second;
  const fs::path file = fs::path(MALUS_SCENES) / "effects" / name / "scene.json";
  pack::Scene scene = bake::bake(bake::readSceneFile(file), {}, [](std::string_view) {}).scene;
  scene.height = scene.height * 160 / scene.width;
  scene.width = 160;
  return baked.emplace(name, std::move(scene)).first->second;
}

class EffectScenes : public testing::TestWithParam<std::string> {};

TEST_P(EffectScenes, RenderersAgreeWithTheReference) {
  const auto results = test::renderEverywhere(sceneNamed(GetParam()));
  const RenderResult& truth = results.at("reference");
  for (const auto& [name, result] : results) {
    ASSERT_EQ(result.pixels.size(), truth.pixels.size());
    std::size_t off = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); i += truth.channels) {
      double largest = 0;
      for (std::size_t k = 0; k < truth.channels; ++k)
        largest = std::max(largest, static_cast<double>(std::abs(result.pixels[i + k] - truth.pixels[i + k])));
      if (largest > 1e-3) ++off;
    }
    EXPECT_LE(off, 3u) << name;  // at edges
  }
}

TEST_P(EffectScenes, NeedsItsEffectAndNoOtherOfThese) {
  const pack::Scene& scene = sceneNamed(GetParam());
  const EffectScene& expected = scenes().at(GetParam());
  for (const auto& [name, other] : scenes())
    EXPECT_EQ(bake::isOn(scene.effects, std::string_view(other.effect)), name == GetParam()) << other.effect;
  // Without it the image differs.
  const RenderParameters parameters = render::defaultParameters(scene);
  const RenderResult truth = reference::render(scene, parameters, 0),
                     without = reference::render(bake::withoutEffects(scene, {expected.effect}), parameters, 0);
  EXPECT_GT(render::imageError(without, truth, 0).relRms, expected.leastChange);
  // An effect that is forced off causes a warning.
  std::vector<std::string> kept;
  for (const pack::Effect& e : scene.effects)
    if (e.name != expected.effect) kept.push_back(e.name);
  const bake::ImageRequest request{parameters.depth, parameters.analyser, false, false};
  const auto choice = render::chooseEffects(kept, "stokes", scene, request);
  ASSERT_EQ(choice.off, std::vector<std::string>{expected.effect});
  ASSERT_EQ(choice.warnings.size(), 1u);
  EXPECT_EQ(shaders::effectName(choice.warnings[0].effect), expected.effect);
  EXPECT_NE(choice.warnings[0].text.find(expected.effect), std::string::npos);
}

// On Vulkan, whose variants differ, and on packets of Embree, which test the effects of the image where everything is
// compiled in; tests/hard_cases draws every other scene by each build. `sp` distinguishes light without a polarization
// direction from polarized light of degree 0.
TEST_P(EffectScenes, AutoEqualsAll) {
  const pack::Scene& scene = sceneNamed(GetParam());
  vulkan::Renderer vulkan(scene, {});
  embree::Renderer embree(scene, 0);
  RenderParameters parameters = render::defaultParameters(scene);
  for (render::Renderer* renderer : {static_cast<render::Renderer*>(&vulkan), static_cast<render::Renderer*>(&embree)})
    for (const char* method : {"stokes", "importance", "sp"}) {
      parameters.everyEffect = false;
      const RenderResult some = renderer->render(method, parameters);
      parameters.everyEffect = true;
      const RenderResult all = renderer->render(method, parameters);
      double largest = 0;
      for (std::size_t i = 0; i < all.pixels.size(); ++i)
        largest = std::max(largest, static_cast<double>(std::abs(all.pixels[i] - some.pixels[i])));
      EXPECT_LT(largest, 2e-5) << method << " " << renderer->device();  // radiances of up to 4
    }
}

// A path that loses no more than the tolerance changes a pixel by no more than that of the brightest source; at 0
// nothing is lost.
TEST_P(EffectScenes, ToleranceBoundsTheError) {
  const pack::Scene& scene = sceneNamed(GetParam());
  embree::Renderer embree(scene, 0);
  RenderParameters parameters = render::defaultParameters(scene);
  const RenderResult exact = embree.render("importance", parameters);
  // The brightest source, which an image may show only in mirrors; a Rayleigh sky is up to 1.5 times its mean.
  double most = *std::max_element(exact.pixels.begin(), exact.pixels.end());
  for (int c = 0; c < 3; ++c) {
    most = std::max(most, 1.5 * scene.environment.radiance[c]);
    for (const Material& m : scene.materials) most = std::max(most, m.radiance[c]);
  }
  std::uint64_t rays = exact.cost.rays;
  for (const double tolerance : {1e-6, 1e-4, 1e-3}) {
    parameters.tolerance = tolerance;
    const RenderResult result = embree.render("importance", parameters);
    EXPECT_LE(result.cost.rays, rays);
    rays = result.cost.rays;
    double largest = 0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
      largest = std::max(largest, static_cast<double>(std::abs(result.pixels[i] - exact.pixels[i])));
    EXPECT_LE(largest, (parameters.depth + 16) * tolerance * most) << tolerance;
  }
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const auto& [name, expected] : scenes()) list.push_back(name);
  return list;
}
INSTANTIATE_TEST_SUITE_P(All, EffectScenes, testing::ValuesIn(names()), [](const auto& given) {
  std::string name = given.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(EffectScene, EveryFolderIsListed) {
  std::set<std::string> folders;
  for (const auto& entry : fs::directory_iterator(fs::path(MALUS_SCENES) / "effects"))
    folders.insert(entry.path().filename());
  const std::vector<std::string> listed = names();
  EXPECT_EQ(folders, (std::set<std::string>(listed.begin(), listed.end())));
}

}  // namespace
}  // namespace malus
