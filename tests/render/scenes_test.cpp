// The three scenes, small, on both renderers: against stored images that were inspected, against each
// other, and against the double-precision reference. Tolerances: tolerances.json.
//
// MALUS_UPDATE_REFERENCES=1 writes the stored images again and fails, so that it cannot go unnoticed. They
// are looked at before they are committed, and never together with the code that they judge.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "meshprep/base/atomic_file.h"
#include "render/compare/image_difference.h"
#include "render/embree/renderer.h"
#include "render/image/output.h"
#include "render/reference/renderer.h"
#include "render/scene/methods.h"
#include "render/vulkan/renderer.h"

namespace malus {
namespace {

namespace fs = std::filesystem;
const std::vector<std::string> kRgb = {"R", "G", "B"};

// Returns a scene as a renderer gets it: baked, written, read back. Each scene is baked once for all tests.
const pack::Pack& scenePack(const std::string& name) {
  static std::map<std::string, pack::Pack> packs;
  const auto at = packs.find(name);
  if (at != packs.end()) return at->second;
  const pack::WriteSettings settings;
  const bake::Baked baked =
      bake::bake(bake::readSceneFile(fs::path(MALUS_SCENES) / name / "scene.json"), settings, [](std::string_view) {});
  return packs.emplace(name, pack::parse(pack::serialize(baked.scene, settings).bytes, name)).first->second;
}

const nlohmann::json& tolerances() {
  static const nlohmann::json kTolerances =
      nlohmann::json::parse(readTextFile(fs::path(MALUS_REFERENCES) / ".." / "tolerances.json"));
  return kTolerances;
}

render::RenderParameters smallView(const pack::Scene& scene) {
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.width = tolerances().at("width").get<std::uint32_t>();
  parameters.height =
      static_cast<std::uint32_t>(std::lround(parameters.width * static_cast<double>(scene.height) / scene.width));
  parameters.region = {0, 0, parameters.width, parameters.height};
  return parameters;
}

image::Image asImage(const pack::Pack& pack, const render::RenderResult& result, const std::string& renderer,
                     const std::string& method) {
  image::Image image = toImage(result, pack, smallView(pack.scene), renderer, method);
  // Devices and packs differ in their names only.
  std::erase_if(image.attributes, [](const auto& a) { return a.first == "malus:device" || a.first == "malus:pack"; });
  return image;
}

image::Image rendered(const pack::Pack& pack, const std::string& renderer, const std::string& method) {
  const render::RenderParameters parameters = smallView(pack.scene);
  if (renderer == "reference") return asImage(pack, reference::render(pack.scene, parameters, 0), renderer, method);
  if (renderer == "embree")
    return asImage(pack, embree::Renderer(pack.scene, 0).render(method, parameters), renderer, method);
  return asImage(pack, vulkan::Renderer(pack.scene, {}).render(method, parameters), renderer, method);
}

// kind: a preset of tolerances.json: the difference that makes a pixel an outlier, and the share of outliers
// that edges and other accidents of rounding explain.
void expectClose(const image::Image& a, const image::Image& b, const std::string& kind, const std::string& what) {
  const nlohmann::json& preset = tolerances().at(kind);
  const render::ImageDifference d = render::difference(a, b, kRgb, preset.at("threshold").get<double>());
  EXPECT_EQ(d.nonFinite, 0u) << what;
  EXPECT_LE(static_cast<double>(d.outliers), preset.at("outlierShare").get<double>() * static_cast<double>(d.pixels))
      << what << ": mean " << d.mean << ", rms " << d.rms << ", max " << d.max;
}

class Scenes : public testing::TestWithParam<std::string> {};

TEST_P(Scenes, EqualTheStoredImages) {
  const pack::Pack& pack = scenePack(GetParam());
  const bool update = std::getenv("MALUS_UPDATE_REFERENCES") != nullptr;
  for (const std::string method : {"schlick", "fresnel", "sp", "reference"}) {
    const fs::path stored = fs::path(MALUS_REFERENCES) / fmt::format("{}-{}.exr", GetParam(), method);
    if (update) {
      fs::create_directories(stored.parent_path());
      image::Image image = rendered(pack, method == "reference" ? "reference" : "embree", method);
      render::writeImage(stored, image, 0);
      ADD_FAILURE() << stored << " was written: look at it, commit it by itself, and run again without the variable";
      continue;
    }
    const image::Image expected = image::read(stored);
    if (method == "reference") {
      expectClose(rendered(pack, "reference", method), expected, "stored", "reference");
      continue;
    }
    for (const std::string renderer : {"vulkan", "embree"})
      expectClose(rendered(pack, renderer, method), expected, "stored", renderer + " " + method);
  }
}

TEST_P(Scenes, AgreeBetweenTheRenderers) {
  const pack::Pack& pack = scenePack(GetParam());
  for (const std::string method : {"schlick", "fresnel", "sp", "stokes"})
    expectClose(rendered(pack, "vulkan", method), rendered(pack, "embree", method), "renderers", method);
}

TEST_P(Scenes, StokesEqualsTheDoublePrecisionReference) {
  const pack::Pack& pack = scenePack(GetParam());
  const image::Image reference = rendered(pack, "reference", "reference");
  for (const std::string renderer : {"vulkan", "embree"})
    expectClose(rendered(pack, renderer, "stokes"), reference, "reference", renderer);
}

TEST_P(Scenes, EveryValueIsOneThatLightCanHave) {
  const pack::Scene& scene = scenePack(GetParam()).scene;
  render::RenderParameters parameters = smallView(scene);
  parameters.checkNumerics = true;
  const auto expectSound = [&](const render::RenderResult& result, const std::string& what) {
    EXPECT_EQ(result.faults.count, 0u) << what << ": " << describe(result.faults, scene);
  };
  expectSound(reference::render(scene, parameters, 0), "reference");
  embree::Renderer embree(scene, 0);
  for (const std::string& method : render::methodNames())
    expectSound(embree.render(method, parameters), "embree " + method);
  vulkan::Renderer vulkan(scene, {});
  for (const std::string method : {"stokes", "importance"})
    expectSound(vulkan.render(method, parameters), "vulkan " + method);
}

TEST_P(Scenes, PolarizationIsVisible) {
  // The scenes show polarization: the relative error of the exact unpolarized equation is over 5 % in many pixels.
  const pack::Pack& pack = scenePack(GetParam());
  const image::Image truth = rendered(pack, "reference", "reference"), fresnel = rendered(pack, "embree", "fresnel");
  std::size_t visible = 0;
  const auto count = static_cast<std::size_t>(truth.width * truth.height);
  for (std::size_t i = 0; i < count; ++i) {
    const float a = truth.pixels[i * truth.channels.size() + 1], b = fresnel.pixels[i * fresnel.channels.size() + 1];
    if (std::abs(a - b) > 0.05f * std::max(a, b) && std::abs(a - b) > 0.005f) ++visible;
  }
  EXPECT_GT(static_cast<double>(visible), 0.02 * static_cast<double>(count));
}

INSTANTIATE_TEST_SUITE_P(Paper, Scenes, testing::Values("glass-wall", "cornell-box", "engine"), [](const auto& scene) {
  std::string n = scene.param;
  std::erase(n, '-');
  return n;
});

}  // namespace
}  // namespace malus
