#include "render/bench/cli.h"

#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "bake/pack/reader.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/bench/rays.h"
#include "render/embree/renderer.h"
#include "render/method_option.h"
#include "render/options.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

struct Arguments {
  std::string pack, rayFile;
  JobSettings job;
  RaysBenchSettings settings;
  bool json = false;
};

void writeRays(const std::string& file, const embree::RayLog& log) {
  writeBeside(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << "malus-rays 1\n";
    for (const auto& [kind, rays] : log) {
      out << fmt::format("{} {} {}\n", kind.bounce, kind.shadow ? 1 : 0, rays.size());
      for (const auto* arrays : {&rays.origin, &rays.direction})
        for (const std::vector<float>& array : *arrays)
          out.write(reinterpret_cast<const char*>(array.data()),
                    static_cast<std::streamsize>(array.size() * sizeof(float)));
    }
    if (!out.flush()) throw Error(file, "cannot write the rays", "a disk with free space");
  });
}

void runRays(const Arguments& a) {
  OutputFiles files;
  files.addInput(a.pack);
  files.addOutput(a.rayFile, "--write-rays");
  files.check();
  const pack::Pack pack = pack::read(a.pack);
  const RenderParameters parameters = renderParameters(a.job, pack.scene);
  const RaysBench bench = benchRays(pack.scene, parameters, a.settings);
  if (!a.rayFile.empty())
    writeRays(a.rayFile,
              embree::Renderer(pack.scene, a.settings.threads).logRays(a.settings.methods.front(), parameters));
  console::printText(a.json ? jsonText(toJson(bench)) + "\n" : toTable(bench));
}

}  // namespace

void addBenchCommand(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  a->settings.methods = methodNames();
  CLI::App* bench = app.add_subcommand("bench", "Measure parts of the renderers by themselves");
  bench->require_subcommand(1);
  CLI::App* command = bench->add_subcommand("rays", "Time the rays of a render without the rest of the renderer");
  command->add_option("pack", a->pack, "Scene pack")->required()->type_name("PACK");
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
  command->add_option("--write-rays", a->rayFile, "Also write the rays of the first method to a file")
      ->check(outputName())
      ->type_name("FILE");
  command->callback([a] { runRays(*a); });
}

}  // namespace malus::render
