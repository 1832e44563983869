#include "render/compare/cli.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/compare/results.h"
#include "render/method_option.h"
#include "render/report_script.h"
#include "render/scene/methods.h"
#include "render/vulkan/gpu_model.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

struct Arguments {
  std::vector<std::string> packs;
  std::string output;
  ComparisonSettings settings;
  bool noReport = false, json = false;
};

void runCompare(const Arguments& a) {
  const fs::path folder = a.output;
  std::error_code failed;
  fs::create_directories(folder / "pictures", failed);
  if (failed)
    throw Error((folder / "pictures").string(), "cannot make the folder", "a writable place", failed.message());

  const InterruptScope scope;
  Comparison comparison = compare({a.packs.begin(), a.packs.end()}, a.settings, folder, console::progress);
  console::progressDone();
  const auto depthOf = [&](const pack::Scene& scene) {
    return a.settings.depths.empty() ? scene.depth : a.settings.depths.front();
  };
  const auto keep = [&](const std::vector<vulkan::PipelineStatistics>& list, const std::string& scene) {
    for (const vulkan::PipelineStatistics& s : list) {
      comparison.gpuModel.push_back(vulkan::toJson(s));
      comparison.gpuModel.back()["scene"] = scene;
      if (s.family.empty()) comparison.gpuModel.back()["family"] = s.device;  // a real one
    }
  };
  // What the compiler of the device that was timed tells of its pipelines, where it tells.
  const auto& backends = a.settings.backends;
  if (std::find(backends.begin(), backends.end(), Backend::vulkan) != backends.end())
    for (const auto& [name, pack] : comparison.packs)
      if (!comparison.interrupted && comparison.devices.contains("vulkan")) try {
          keep(vulkan::deviceStatistics(pack.scene, a.settings.methods, depthOf(pack.scene), a.settings.device), name);
        } catch (const Error& error) {  // what was timed is worth more
          console::warn(fmt::format("{}: no statistics of the device's pipelines: {}", name, error.what()));
        }
  // Compilers' estimates for GPUs that are not here.
  for (const std::string& family : a.settings.gpuFamilies)
    for (std::size_t i = 0; i < a.packs.size() && !comparison.interrupted; ++i) {
      const pack::Scene scene = pack::read(a.packs[i]).scene;
      console::progress(fmt::format("{}: compiling for {}", scene.name, family));
      keep(vulkan::gpuModel(a.packs[i], family, a.settings.methods, depthOf(scene)), scene.name);
    }
  const nlohmann::json results = toJson(comparison, a.settings);
  writeFile(folder / "results.json", results.dump(1) + "\n");
  writeFile(folder / "results.csv", toCsv(comparison));
  if (a.json)
    fmt::print("{}\n", results.dump(1));
  else
    fmt::print("{}\n", toTable(comparison));
  if (comparison.interrupted) {
    console::warn(fmt::format("interrupted: {} finished rounds are in {}", comparison.rounds, folder.string()));
    throw Interrupted{};
  }
  if (!a.noReport) {
    console::progress("writing the report");
    runReportScript("compare_report.py", {folder.string()}, "",
                    "the report's pages could not be made; results.json and results.csv are there");
    console::progressDone();
    if (!a.json) fmt::print("report: {}\n", (folder / "index.html").string());
  }
}

}  // namespace

void addCompareCommand(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  a->settings.methods = methodNames();
  CLI::App* command = app.add_subcommand("compare", "Compares methods and renderers: error against time");
  command->add_option("packs", a->packs, "scene packs")->required();
  command->add_option("-o,--output", a->output, "folder for the report")->required();
  command->add_option("--methods", a->settings.methods, "methods (default: all)")
      ->delimiter(',')
      ->transform(methodName());
  command
      ->add_option_function<std::vector<std::string>>(
          "--backends",
          [a](const std::vector<std::string>& names) {
            a->settings.backends.clear();
            for (const std::string& name : names) a->settings.backends.push_back(backendNamed(name));
          },
          "renderers (default: both)")
      ->delimiter(',')
      ->check(CLI::IsMember(methodBackendNames()));
  auto* width = command->add_option("--width", a->settings.widths, "widths of the pictures (default: the scene's)")
                    ->delimiter(',')
                    ->check(CLI::Range(1u, 16384u));
  auto* height = command->add_option("--height", a->settings.heights, "their heights (default: by the scene's aspect)")
                     ->delimiter(',')
                     ->check(CLI::Range(1u, 16384u));
  command->add_option("--scale", a->settings.scale, "size relative to the scene's, along each side")
      ->check(CLI::Range(0.001, 4.0))
      ->excludes(width)
      ->excludes(height);
  command->add_option("--depth", a->settings.depths, "depths (default: the scene's)")
      ->delimiter(',')
      ->check(CLI::Range(0u, pack::kMaxDepth));
  command->add_option("--rounds", a->settings.rounds, "timed rounds after the warm-up")->capture_default_str();
  command->add_option("--threads", a->settings.threads, "CPU threads, 0 for all")
      ->check(CLI::Range(0u, 1024u))
      ->capture_default_str();
  command->add_option("--device", a->settings.device, "Vulkan device: number or part of its name from --list-devices");
  command->add_option("--polarizer", a->settings.polarizerDegrees,
                      "linear polarizer in front of the camera, in degrees");
  command
      ->add_option("--gpu-model", a->settings.gpuFamilies,
                   "GPU families (navi21, navi31, ...): a compiler's static cost estimate for each, not a time")
      ->delimiter(',');
  command->add_flag("--no-report", a->noReport, "results.json, results.csv and pictures only");
  command->add_flag("--json", a->json, "print results.json instead of the table");
  command->callback([a] { runCompare(*a); });
}

}  // namespace malus::render
