// --max-error keeps its promise: over a grid of scenes, errors, filters and sizes, the error of the full image stays
// within the bound in at least 95 % of the cases.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bake/bake.h"
#include "bake/pack/reader.h"
#include "bake/scene_file/scene_file.h"
#include "render/budget/display_error.h"
#include "render/job.h"
#include "render/scene/methods.h"

namespace malus::render {
namespace {
namespace fs = std::filesystem;

constexpr double kShareWithin = 0.95;

struct Case {
  std::string scene;
  double bound = 0, found = 0;
  std::string chosen;
  bool isFaster = false;  // than the image by the exact rules of --effects auto alone, once each
};

// Error of the image that --max-error makes, against the exact method with every effect.
Case measure(const pack::Pack& pack, double bound, std::uint32_t width, const Analyser& analyser) {
  JobSettings settings;
  settings.method = completeRecursiveMethod().name;
  settings.width = width;
  settings.analyser = analyser;
  Job exact(pack, settings);
  settings.maxError = bound;
  Job budget(pack, settings);
  const RenderResult truth = exact.render(), image = budget.render();
  return {fmt::format("{}, {} pixels{}", pack.scene.name, width, analyser == kNoFilter ? "" : ", polarizer"), bound,
          displayError(image, truth, pack.scene.exposureEv).relRms(), budget.method(),
          image.cost.traceMs < truth.cost.traceMs};
}

std::vector<fs::path> scenes() {
  std::vector<fs::path> list;
  for (const char* folder : {"", "effects", "hard"})
    for (const auto& entry : fs::directory_iterator(fs::path(MALUS_SCENES) / folder))
      if (fs::exists(entry.path() / "scene.json")) list.push_back(entry.path() / "scene.json");
  return list;
}

TEST(Budget, KeepsTheErrorInNearlyEveryCase) {
  const fs::path cache = fs::temp_directory_path() / fmt::format("malus-budget-{}", ::getpid());
  ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  std::size_t cases = 0, within = 0, faster = 0;
  std::string exceeded;
  for (const fs::path& scene : scenes()) {
    const pack::WriteSettings settings;
    const bake::Baked baked = bake::bake(bake::readSceneFile(scene), settings, [](std::string_view) {});
    const pack::Pack pack =
        pack::parse(pack::serialize(baked.scene, settings).bytes, scene.parent_path().filename().string());
    for (const std::uint32_t width : {200u, 420u})
      for (const Analyser& analyser : {kNoFilter, linearPolarizer(60)})
        for (const double bound : {0.001, 0.01, 0.05}) {
          const Case result = measure(pack, bound, width, analyser);
          ++cases;
          faster += result.isFaster ? 1 : 0;
          if (result.found <= bound)
            ++within;
          else
            exceeded +=
                fmt::format("  {}: {} has {:.3g}, bound {:g}\n", result.scene, result.chosen, result.found, bound);
        }
  }
  fs::remove_all(cache);
  EXPECT_GE(static_cast<double>(within), kShareWithin * static_cast<double>(cases)) << exceeded;
  std::printf("%zu of %zu cases within the bound; others:\n%s", within, cases, exceeded.c_str());
  std::printf("the exact rules alone took longer in %zu of %zu cases\n", faster, cases);
}

}  // namespace
}  // namespace malus::render
