#include "render/bench/cli.h"

#include <memory>

#include "bake/pack/reader.h"
#include "meshprep/base/console.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/bench/rays.h"
#include "render/method_option.h"
#include "render/options.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

struct Arguments {
  PackInput input;
  JobSettings job;
  RaysBenchSettings settings;
  bool json = false;
};

void runRays(const Arguments& a) {
  OutputFiles files;
  addInputs(files, a.input);
  files.addOutput(a.settings.rayFile, "--write-rays");
  files.check();
  const pack::Pack pack = pack::read(packFile(a.input));
  const RenderParameters parameters = renderParameters(a.job, pack.scene);
  const RaysBench bench = benchRays(pack.scene, parameters, a.settings);
  console::printText(a.json ? jsonText(toJson(bench)) + "\n" : toTable(bench));
}

}  // namespace

void addBenchCommand(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  a->settings.methods = methodNames();
  CLI::App* bench = app.add_subcommand("bench", "Measure parts of the renderers by themselves");
  bench->require_subcommand(1);
  CLI::App* command = bench->add_subcommand("rays", "Time the rays of a render without the rest of the renderer");
  addPackInput(*command, a->input);
  command->add_option("--methods", a->settings.methods, "Methods (default: all)")
      ->delimiter(',')
      ->transform(methodName());
  addWidth(*command, a->job.width);
  addHeight(*command, a->job.height);
  addDepth(*command, a->job.depth);
  addBackends(*command, a->settings.backends, "Renderers (default: embree)");
  addDevice(*command, a->settings.device, a->settings.threads);
  command->add_option("--rounds", a->settings.rounds, "Repetitions; the least time counts")
      ->transform(wholeNumberBetween(1, 1000))
      ->capture_default_str();
  command->add_flag("--json", a->json, "Print the result as JSON");
  command->add_option("--write-rays", a->settings.rayFile, "Also write the rays of the first method to a file")
      ->check(outputName())
      ->type_name("FILE");
  command->callback([a] { runRays(*a); });
}

}  // namespace malus::render
