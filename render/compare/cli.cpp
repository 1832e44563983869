#include "render/compare/cli.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"

#include "meshprep/base/interrupt.h"
#include "meshprep/base/output_files.h"
#include "meshprep/base/usage_error.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/ablation/ablation.h"
#include "render/ablation/results.h"
#include "render/compare/devices_table.h"
#include "render/compare/results.h"
#include "render/compare/time_limit.h"
#include "render/method_option.h"
#include "render/options.h"
#include "render/pack_input.h"
#include "render/report_script.h"
#include "render/scene/methods.h"
#include "render/vulkan/gpu_model.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

struct Arguments {
  std::vector<std::string> inputs, shown;
  std::vector<std::string> packs;  // of the inputs
  bake::ModelPackOptions model;
  std::string output;
  ComparisonSettings settings;
  bool noReport = false, json = false;
  bool effects = false;           // --effects: an ablation instead of a comparison of methods
  std::optional<double> minutes;  // --minutes

  // Depth at which pipelines are compiled for statistics.
  std::uint32_t depth(const pack::Scene& scene) const {
    return settings.depths.empty() ? scene.depth : settings.depths.front();
  }
};

void append(Comparison& comparison, const std::vector<vulkan::PipelineStatistics>& list, const std::string& scene) {
  for (const vulkan::PipelineStatistics& s : list) {
    nlohmann::json entry = vulkan::toJson(s);
    entry["scene"] = scene;
    if (s.family.empty()) entry["family"] = s.device;  // a real device
    comparison.gpuModel.push_back(std::move(entry));
  }
}

// Adds the statistics that the driver of the timed device reports of its pipelines, if it does.
void addDeviceStatistics(Comparison& comparison, const Arguments& a) {
  if (!comparison.devices.contains(backendInfo(Backend::vulkan).name)) return;
  for (const auto& [name, pack] : comparison.packs)
    if (!comparison.interrupted && !comparison.timeIsOver) try {
        append(comparison,
               vulkan::deviceStatistics(pack.scene, a.settings.methods, a.depth(pack.scene), a.settings.device,
                                        a.settings.vulkanPath),
               name);
      } catch (const Error& error) {  // the timings are still valid
        console::warn(fmt::format("{}: no statistics of the device's pipelines: {}", name, error.what()));
      }
}

// Adds a compiler's estimates for GPU families that this machine does not have.
void addFamilyEstimates(Comparison& comparison, const Arguments& a) {
  for (const std::string& family : a.settings.gpuFamilies)
    for (const std::string& path : a.packs) {
      if (comparison.interrupted) return;
      const pack::Scene scene = pack::read(path).scene;
      console::progress(fmt::format("{}: compiling for {}", scene.name, family));
      append(comparison, vulkan::gpuModel(path, family, a.settings.methods, a.depth(scene)), scene.name);
    }
}

// Throws UsageError for the folder of a comparison, whose report would be lost.
void requireNoComparison(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / "results.json", ignored) && fs::exists(folder / "index.html", ignored))
    throw UsageError("--output", fmt::format("{} has the report of a comparison", folder.string()), "another folder");
}

// Writes results.json of an ablation.
void writeAblation(const Ablation& ablation, const AblationSettings& settings, const Arguments& a) {
  writeFile(fs::path(a.output) / "results.json", jsonText(toJson(ablation, settings), 1) + "\n");
}

// The settings of an ablation; throws UsageError for options that it does not have.
AblationSettings ablationSettings(const Arguments& a) {
  const ComparisonSettings& c = a.settings;
  if (c.widths.size() > 1 || c.heights.size() > 1 || c.depths.size() > 1)
    throw UsageError("--effects", "measures one size and depth", "one value of --width, --height and --depth");
  AblationSettings settings;
  if (!c.backends.empty()) settings.backends = c.backends;
  settings.image.width = c.widths.empty() ? 0 : c.widths.front();
  settings.image.height = c.heights.empty() ? 0 : c.heights.front();
  if (!c.depths.empty()) settings.image.depth = c.depths.front();
  if (c.polarizerDegrees) settings.image.analyser = linearPolarizer(*c.polarizerDegrees);
  settings.image.device = c.device;
  settings.image.threads = c.threads;
  settings.image.vulkanPath = c.vulkanPath;
  settings.image.embreePath = c.embreePath;
  settings.rounds = c.rounds;
  settings.minutes = a.minutes.value_or(settings.minutes);
  return settings;
}

void finishAblation(const Ablation& ablation, const AblationSettings& settings, const Arguments& a) {
  writeAblation(ablation, settings, a);
  if (a.json)
    console::printText(jsonText(toJson(ablation, settings), 1) + "\n");
  else
    console::printText(toTable(ablation) + "\n");
  if (ablation.interrupted) {
    console::warn(
        fmt::format("interrupted: {} rows and their finished rounds are in {}", ablation.rows.size(), a.output));
    throw Interrupted{};
  }
  if (ablation.leftOut > 0 || ablation.timeIsOver)
    console::warn(
        fmt::format("the time of --minutes is over: {} rows left out, each other one has at least {} of {} rounds",
                    ablation.leftOut, ablation.rounds, settings.rounds));
  if (a.noReport) return;
  console::progress("writing the report");
  runReportScript("effects_report.py", {a.output}, "", "cannot write the report; results.json is complete");
  console::progressDone();
  if (!a.json) console::printLine("report: {}", (fs::path(a.output) / "index.html").string());
}

// The results of several devices side by side, and their page if there is an output folder.
void showDevices(const Arguments& a) {
  std::vector<nlohmann::json> results;
  for (const std::string& file : a.shown) results.push_back(readResults(file));
  OutputFiles files;
  for (const std::string& file : a.shown) files.addInput(file);
  if (!a.output.empty()) {
    files.addOutputFolder(a.output, "--output");
    files.addOutput(fs::path(a.output) / "index.html", "--output");
    requireNoComparison(a.output);
  }
  files.check();
  console::printText(devicesTable(results) + "\n");
  if (a.output.empty() || a.noReport) return;
  std::error_code failed;
  fs::create_directories(a.output, failed);
  if (failed) throw Error(a.output, "cannot create the folder", "a writable place", failed.message());
  std::vector<std::string> arguments = {a.output, fmt::format("{}", fmt::join(methodNames(), ","))};
  arguments.insert(arguments.end(), a.shown.begin(), a.shown.end());
  runReportScript("devices_report.py", arguments, "", "cannot write the report");
  console::printLine("report: {}", (fs::path(a.output) / "index.html").string());
}

// The options for model files apply to every model; they need one.
void addAllInputs(OutputFiles& files, const Arguments& a) {
  const bool hasModel = std::ranges::any_of(a.inputs, [](const std::string& file) { return bake::isModelFile(file); });
  for (const std::string& file : a.inputs)
    addInputs(files, {file, bake::isModelFile(file) || !hasModel ? a.model : bake::ModelPackOptions()});
}

// Refuses to write a report over a pack.
void checkFiles(const Arguments& a) {
  const fs::path folder = a.output;
  OutputFiles files;
  addAllInputs(files, a);
  files.addOutputFolder(folder, "--output");
  files.addOutputFolder(folder / "images", "--output");
  for (const char* file : {"results.json", "results.csv", "index.html"}) files.addOutput(folder / file, "--output");
  files.check();
  // Images have names that differ, so only an existing one can be a pack. Images of an earlier comparison may be hard
  // links of each other, which is harmless, because each is replaced by renaming.
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "images", ignored)) {
    OutputFiles image;
    addAllInputs(image, a);
    image.addOutput(entry.path(), "--output");
    image.check();
  }
}

void writeResults(const Comparison& comparison, const Arguments& a) {
  const fs::path folder = a.output;
  writeFile(folder / "results.json", jsonText(toJson(comparison, a.settings), 1) + "\n");
  writeFile(folder / "results.csv", toCsv(comparison));
}

void checkArguments(const Arguments& a) {
  if (!a.shown.empty() && !a.inputs.empty())
    throw CLI::ValidationError("--show", "excludes scene packs: it shows results of earlier comparisons");
  if (a.shown.empty() && a.inputs.empty()) throw CLI::RequiredError("PACK, or --show with a results.json,");
  if (a.shown.empty() && a.output.empty()) throw CLI::RequiredError("--output");
}

void runCompare(Arguments& a) {
  checkArguments(a);
  if (!a.shown.empty()) return showDevices(a);
  checkFiles(a);
  for (const std::string& file : a.inputs) a.packs.push_back(packFile({file, a.model}));
  const console::PeriodicProgress periodic;
  const fs::path folder = a.output;
  std::error_code failed;
  fs::create_directories(folder / "images", failed);
  if (failed)
    throw Error((folder / "images").string(), "cannot create the folder", "a writable place", failed.message());

  a.settings.minutes = a.minutes.value_or(a.settings.minutes);
  a.settings.compileMinutes = compileMinutes(a.minutes);
  const InterruptScope scope;
  if (a.effects) {
    const AblationSettings settings = ablationSettings(a);
    const Ablation ablation = ablate({a.packs.begin(), a.packs.end()}, settings, folder, console::progress,
                                     [&](const Ablation& finished) { writeAblation(finished, settings, a); });
    console::progressDone();
    return finishAblation(ablation, settings, a);
  }
  Comparison comparison = compare({a.packs.begin(), a.packs.end()}, a.settings, folder, console::progress,
                                  [&](const Comparison& finished) { writeResults(finished, a); });
  console::progressDone();
  addDeviceStatistics(comparison, a);
  addFamilyEstimates(comparison, a);
  writeResults(comparison, a);
  if (a.json)
    console::printText(jsonText(toJson(comparison, a.settings), 1) + "\n");
  else
    console::printText(toTable(comparison) + "\n");
  if (comparison.interrupted) {
    console::warn(fmt::format("interrupted: {} finished rounds are in {}", comparison.rounds, folder.string()));
    throw Interrupted{};
  }
  if (comparison.timeIsOver)
    console::warn(
        fmt::format("the time of --minutes is over after {} of {} rounds", comparison.rounds, a.settings.rounds));
  if (a.noReport) return;
  console::progress("writing the report");
  runReportScript("compare_report.py", {folder.string()}, "",
                  "cannot write the report; results.json and results.csv are complete");
  console::progressDone();
  if (!a.json) console::printLine("report: {}", (folder / "index.html").string());
}

}  // namespace

void addCompareCommand(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  ComparisonSettings& settings = a->settings;
  settings.methods = methodNames();
  CLI::App* command = app.add_subcommand("compare", "Compare methods and renderers: error against time");
  command->add_option("packs", a->inputs, "Scene packs, or models: glTF, OBJ, PLY, STL, OFF")->type_name("PACK");
  addModelOptions(*command, a->model);
  command->add_option("-o,--output", a->output, "Folder for the report")->check(outputName())->type_name("FOLDER");
  CLI::Option* show =
      command->add_option("--show", a->shown, "Print the results of several devices side by side, render nothing")
          ->type_name("FILE...");
  CLI::Option* methods = command->add_option("--methods", settings.methods, "Methods (default: all)")
                             ->delimiter(',')
                             ->transform(methodName());
  CLI::Option* effects = command->add_flag(
      "--effects", a->effects,
      "Measure what each effect, bounce and kind of polarization gives and costs, instead of methods");
  addBackends(*command, settings.backends, "Renderers (default: all that render by methods)");
  CLI::Option* width = addWidth(*command, settings.widths);
  CLI::Option* height = addHeight(*command, settings.heights);
  CLI::Option* scale =
      command->add_option("--scale", settings.scale, "Size relative to the pack's, along each side (default: 1)")
          ->transform(numberBetween(0.001, 4))
          ->excludes(width)
          ->excludes(height);
  addDepth(*command, settings.depths);
  command->add_option("--rounds", settings.rounds, "Timed rounds after the warm-up")
      ->transform(wholeNumberBetween(1, 1000000))
      ->capture_default_str();
  command
      ->add_option(
          "--minutes", a->minutes,
          "Time limit: leaves out methods and rounds that exceed it, the first methods are preferred; 0 for none "
          "(default: 0, or 10 with --effects; where Vulkan runs on a CPU, it starts no method after a quarter "
          "of M or 5)")
      ->transform(nonNegativeNumber());
  addDevice(*command, settings.device, settings.threads);
  addPaths(*command, settings.vulkanPath, settings.embreePath);
  command
      ->add_option("--polarizer", settings.polarizerDegrees,
                   "Linear polarizer in front of the camera, from the image's x axis, counter-clockwise [degrees]")
      ->transform(anyNumber());
  CLI::Option* gpuModel = command
                              ->add_option("--gpu-model", settings.gpuFamilies,
                                           "GPU families (navi21, navi31, ...) for a compiler's static cost estimate")
                              ->delimiter(',');
  effects->excludes(methods)->excludes(scale)->excludes(gpuModel)->excludes(show);
  command->add_flag("--no-report", a->noReport, "Write only results.json, results.csv and the images");
  command->add_flag("--json", a->json, "Print results.json instead of the table");
  command->callback([a] { runCompare(*a); });
}

}  // namespace malus::render
