#include "render/batch/cli.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/batch/batch.h"
#include "render/batch/tile_files.h"
#include "render/batch/tiles.h"
#include "render/effects_option.h"
#include "render/filter_options.h"
#include "render/options.h"
#include "render/output_folder.h"
#include "render/scene/methods.h"
#include "render/sensor_options.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

struct BatchArguments {
  PackInput input;
  std::string jobs, folder;
  SensorOptions sensor;  // without its files
  FrameDefaults defaults;
  std::vector<std::string> outputs = {"exr"};
  std::uint64_t seed = 0;
  std::string shard;
  bool tiles = false;
  bool json = false;
};

// Refuses to write over an input: a new file cannot be one.
void checkFiles(const BatchArguments& a, const Jobs& jobs) {
  OutputFiles files;
  addInputs(files, a.input);
  files.addInput(a.jobs);
  addSensorFiles(files, a.sensor);
  files.addOutputFolder(a.folder, "--output");
  files.addOutput(fs::path(a.folder) / kManifestFile, "--output");
  std::error_code ignored;
  if (a.tiles) {
    for (const fs::directory_entry& entry : fs::directory_iterator(a.folder, ignored))
      if (isTileFileName(entry.path().filename().string())) files.addOutput(entry.path(), "--output");
    files.check();
    return;
  }
  for (std::size_t i = 0; fs::exists(a.folder, ignored) && i < jobs.size(); ++i)
    for (const FrameOutputInfo& info : kFrameOutputs)
      if (const fs::path file = fs::path(a.folder) / (jobs.name(i) + info.suffix); fs::exists(file, ignored))
        files.addOutput(file, "--output");
  files.check();
}

void printResult(const BatchArguments& a, const std::string& scene, const Jobs& jobs, const BatchResult& result) {
  if (a.json) {
    nlohmann::json document = {{"scene", scene},
                               {"frames", jobs.size()},
                               {"rendered", result.rendered},
                               {"reused", result.reused},
                               {"seconds", result.seconds},
                               {a.tiles ? "tilesPerMinute" : "framesPerMinute", result.perMinute()},
                               {"accelerationBuilds", result.builds},
                               {"sceneUpdates", result.updates},
                               {"manifest", (fs::path(a.folder) / kManifestFile).string()}};
    if (a.tiles) document["tiles"] = result.tiles;
    console::printText(jsonText(document) + "\n");
    return;
  }
  const std::string unit = a.tiles ? fmt::format("of {} tiles", result.tiles) : "frames";
  console::printLine("{}: {} {} rendered in {:.1f} s ({:.3g} per minute), {} finished before; {}", scene,
                     result.rendered, unit, result.seconds, result.perMinute(), result.reused,
                     (fs::path(a.folder) / kManifestFile).string());
}

void runBatchCommand(const BatchArguments& a) {
  BatchSettings settings;
  settings.folder = a.folder;
  settings.defaults = a.defaults;
  settings.seed = a.seed;
  settings.defaults.outputs = FrameOutputs(a.outputs, "--outputs");
  if (const std::optional<Sensor> sensor = readSensor(a.sensor))
    settings.defaults.sensor = std::make_shared<const Sensor>(*sensor);
  if (!a.shard.empty()) settings.shard = *parseShard(a.shard);
  settings.tiles = a.tiles;
  makeAnalyser(a.defaults.filter);  // refuses filters that exclude each other
  const Jobs jobs(readJobLines(a.jobs), a.seed);
  checkFiles(a, jobs);
  FrameRenderer renderer(pack::read(packFile(a.input)), a.defaults.job.backend, a.defaults.job.device,
                         a.defaults.job.threads);
  const OutputFolder made(a.folder);
  const console::PeriodicProgress progress;
  const BatchResult result = runBatch(settings, jobs, renderer);
  printResult(a, renderer.scene().name, jobs, result);
}

CLI::Validator shardText() {
  return {[](std::string& text) { return parseShard(text) ? "" : "expected K/N with K from 1 to N, found " + text; },
          "K/N"};
}

}  // namespace

void addBatchCommand(CLI::App& app) {
  auto a = std::make_shared<BatchArguments>();
  a->defaults.job.method = completeRecursiveMethod().name;
  CLI::App* command = app.add_subcommand(
      "batch", "Render many views of a scene: cameras, filters, materials and ground truth per frame");
  addJobOptions(*command, a->input, a->defaults.job);
  command->add_option("jobs", a->jobs, "Frames: JSON Lines (.jsonl) or a table (.csv)")->required()->type_name("JOBS");
  command->add_option("-o,--output", a->folder, "Folder for the files of the frames and manifest.jsonl")
      ->required()
      ->check(outputName())
      ->type_name("FOLDER");
  command
      ->add_option("--outputs", a->outputs,
                   fmt::format("Files of each frame, with commas: {}", fmt::join(frameOutputNames(), ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(frameOutputNames()))
      ->default_str("exr");
  addFilterOptions(*command, a->defaults.filter);
  addEffects(*command, a->defaults.job.effects);
  addExposure(*command, a->defaults.exposure);
  addSensor(*command, a->sensor.sensor);
  addCompression(*command, a->defaults.compression);
  command->add_option("--seed", a->seed, "Seed of the values that jobs draw at random")
      ->transform(wholeNumberBetween(0, 0xffffffff))
      ->capture_default_str();
  command->add_option("--shard", a->shard, "Render part K of N of the frames only: every N-th index")
      ->check(shardText())
      ->type_name("K/N");
  command->add_flag("--tiles", a->tiles,
                    fmt::format("Render tiles of {0} x {0} pixels, divided among the shards; 'malus merge' writes the "
                                "frames",
                                kFrameTileSide));
  command->add_flag("--json", a->json, "Print the result as JSON");
  command->callback([a] { runBatchCommand(*a); });
}

}  // namespace malus::render
