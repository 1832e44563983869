#include "bake/cli.h"

#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/bake_file.h"
#include "bake/bake_report.h"
#include "bake/diff.h"
#include "bake/info.h"
#include "bake/materials/presets.h"
#include "bake/model/model_cli.h"
#include "bake/model/model_scene.h"
#include "bake/pack/reader.h"
#include "bake/scene_file/scene_file.h"
#include "bake/scene_file/write_scene_file.h"
#include "bake/unpack.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/output_files.h"
#include "meshprep/deprecated_option.h"
#include "meshprep/json_text.h"
#include "meshprep/number_option.h"
#include "meshprep/output_option.h"
#include "meshprep/read/source_scene.h"
#include "shaders/effects.h"

namespace malus::bake {

namespace {

struct BakeArguments {
  std::string input;
  BakeJob job;
  ModelOptions model;
  std::filesystem::path sceneFile;  // --write-scene
  bool json = false;
};

// Refuses to write the pack or the scene over a file of the scene, or over a material library of a mesh, which is not
// read.
void checkFiles(const BakeArguments& arguments, const std::vector<SourceFile>& sources) {
  OutputFiles files;
  files.addInput(arguments.input);
  for (const SourceFile& source : sources) {
    files.addInput(source.file);
    std::error_code ignored;
    if (!source.mayBeMissing && std::filesystem::is_regular_file(source.file, ignored))
      for (const std::filesystem::path& file : prep::referencedFiles(source.file)) files.addInput(file);
  }
  files.addOutput(arguments.job.output, "--output");
  files.addOutput(arguments.sceneFile, "--write-scene");
  files.check();
}

void checkArguments(const BakeArguments& arguments) {
  requireModel(arguments.input, arguments.model, "a scene description");
  if (!arguments.sceneFile.empty() && !isModelFile(arguments.input))
    throw CLI::ValidationError("--write-scene", "is for model files (glTF, OBJ, PLY, STL, OFF)");
  if (arguments.job.output.empty() && arguments.sceneFile.empty())
    throw CLI::RequiredError("--output, or --write-scene with a model file,");
}

void report(const BakeArguments& arguments, const BakedFile& file) {
  const std::string output = arguments.job.output.string();
  if (file.isUpToDate) {
    if (arguments.json)
      console::printText(
          jsonText({{"name", file.name}, {"output", output}, {"upToDate", true}, {"warnings", file.warnings}}) + "\n");
    else
      console::printLine("{}: {} is up to date: sources and settings are unchanged", file.name, output);
    return;
  }
  nlohmann::json document = bakeJson(file.baked, file.written, output);
  if (!arguments.sceneFile.empty()) document["sceneFile"] = arguments.sceneFile.string();
  if (arguments.json)
    console::printText(jsonText(document) + "\n");
  else if (!output.empty())
    console::printText(bakeText(file.baked, file.written, output, file.isRebaked));
  if (!arguments.sceneFile.empty() && !arguments.json)
    console::printLine("{}: the scene of {}", arguments.sceneFile.string(), arguments.input);
}

void runBake(const BakeArguments& arguments) {
  checkArguments(arguments);
  checkFiles(arguments, {});
  const SceneDescription description =
      isModelFile(arguments.input) ? describeModel(arguments.input, arguments.model) : readSceneFile(arguments.input);
  checkFiles(arguments, sourceFiles(description));
  std::error_code ignored;
  if (!arguments.sceneFile.empty() && std::filesystem::exists(arguments.sceneFile, ignored))
    throw Error(arguments.sceneFile.string(), "exists, and may have been edited",
                "a new file for --write-scene, or remove this one");
  for (const std::string& deprecation : description.deprecations) console::note(deprecation);
  BakeJob job = arguments.job;
  job.isForced = job.isForced || !arguments.sceneFile.empty();  // a pack does not have the scene as it was written
  const BakedFile file = bakeFile(description, job);
  if (!arguments.sceneFile.empty())
    writeFile(arguments.sceneFile, sceneFileText(file.baked.description, arguments.sceneFile));
  report(arguments, file);
}

}  // namespace

void addBakeCommand(CLI::App& app, MeasureDepth measure) {
  auto arguments = std::make_shared<BakeArguments>();
  BakeJob& job = arguments->job;
  job.measure = std::move(measure);
  CLI::App* command = app.add_subcommand("bake", "Bake a scene description or a model file into a scene pack");
  command
      ->add_option("scene", arguments->input, "Scene description (bake/SCENE.md), or a model: glTF, OBJ, PLY, STL, OFF")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", job.output, "Pack to write")->check(outputName())->type_name("PACK");
  addModelOptions(*command, arguments->model);
  command
      ->add_option("--write-scene", arguments->sceneFile,
                   "Model files: write the equivalent scene description, to go on from")
      ->check(outputName())
      ->type_name("FILE");
  command
      ->add_option("--position-error", job.settings.bounds.positionError,
                   "Largest distance of a vertex from its source [m]")
      ->transform(positiveNumber())
      ->type_name("METRES");
  command
      ->add_option("--normal-error", job.settings.bounds.normalErrorDegrees,
                   "Largest angle of a normal from its source [degrees]; without it 0.05 is a goal")
      ->transform(positiveNumber())
      ->type_name("DEGREES");
  command
      ->add_option("--max-uv-error", job.settings.bounds.uvErrorTexels,
                   "Largest error of a texture coordinate [texels of the largest image, or of 4096]")
      ->transform(positiveNumber())
      ->type_name("TEXELS");
  command->add_option("--position-bits", job.settings.bounds.positionBits, "Exact number of bits per coordinate")
      ->transform(wholeNumberBetween(1, compress::kMaxPositionBits))
      ->type_name("N");
  command
      ->add_option("--normal-bits", job.settings.bounds.normalBits, "Exact number of bits per coordinate of a normal")
      ->transform(wholeNumberBetween(compress::kMinNormalBits, compress::kMaxNormalBits))
      ->type_name("N");
  command->add_flag("--keep-map", job.settings.keepMap,
                    "Write the map from packed vertices and triangles to those of the source files");
  command->add_flag("--allow-open-glass", job.options.allowOpenGlass,
                    "Bake glass that is not a certified body, with a warning");
  command->add_flag("--strict", job.options.strict,
                    "Fail if a part of a file is invalid or has no area, instead of leaving it out with a warning");
  command->add_flag("--force", job.isForced, "Bake although the pack is up to date, and encode every mesh again");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  addFormerOption(*command, "--max-normal-error", "--normal-error");
  addRemovedOption(*command, "--max-error", "--position-error");  // `render`: relative RMS error
  command->callback([arguments] { runBake(*arguments); });
}

void addInfoCommand(CLI::App& app, MeasurePolarization measure) {
  struct Arguments {
    std::string input, other;
    double tolerance = kInfoTolerance;
    bool verify = false, json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("info", "Print the contents of a scene pack");
  command->add_option("pack", arguments->input, "Scene pack")->required()->type_name("PACK");
  command
      ->add_option("--bounce-tolerance", arguments->tolerance,
                   "Share of the light that deeper bounces than the reported one may change")
      ->transform(numberBetween(0, 1))
      ->capture_default_str();
  command->add_flag("--verify", arguments->verify, "Report that every hash, count and number was checked");
  command
      ->add_option("--diff", arguments->other,
                   "Other pack: print the sections and values that differ, and exit with 3 if any does")
      ->type_name("PACK");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  addRemovedOption(*command, "--tolerance", "--bounce-tolerance");  // `render`: loss along a path
  command->callback([arguments, measure = std::move(measure)] {
    const pack::Pack pack = pack::read(arguments->input);  // makes every check of the reader
    if (!arguments->other.empty()) {
      const nlohmann::json difference = diffJson(pack, pack::read(arguments->other));
      console::printText(arguments->json ? jsonText(difference) + "\n" : diffText(difference));
      if (!difference.at("equal")) throw PacksDiffer{};
      return;
    }
    if (arguments->json) {
      console::printText(jsonText(infoJson(pack, arguments->tolerance, measure)) + "\n");
    } else {
      console::printText(infoText(pack, arguments->tolerance, measure));
      if (arguments->verify)
        console::printLine("verified: {} sections, every hash, count, index and number", pack.sections.size());
    }
  });
}

void addUnpackCommand(CLI::App& app) {
  struct Arguments {
    std::string input, output;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("unpack", "Unpack a scene pack into JSON, PLY and EXR files");
  command->add_option("pack", arguments->input, "Scene pack")->required()->type_name("PACK");
  command->add_option("-o,--output", arguments->output, "Folder to write (contents: bake/unpack.h)")
      ->required()
      ->check(outputName())
      ->type_name("FOLDER");
  command->add_flag("--json", arguments->json, "Print scene.json as well");
  command->callback([arguments] {
    const pack::Pack pack = pack::read(arguments->input);
    OutputFiles files;
    files.addInput(arguments->input);
    files.addOutputFolder(arguments->output, "--output");
    for (const std::filesystem::path& file : unpackedFiles(pack, arguments->output)) files.addOutput(file, "--output");
    files.check();
    const nlohmann::json document = unpack(pack, arguments->output);
    if (arguments->json)
      console::printText(jsonText(document) + "\n");
    else
      console::printLine("{}: {} meshes -> {}", pack.scene.name, pack.scene.meshes.size(), arguments->output);
  });
}

void listMaterials() {
  for (const Preset& preset : presets()) {
    const auto [eta, k] = preset.at(pack::kDefaultWavelengthsNm);
    console::printLine("{:<14} eta {:.4f} {:.4f} {:.4f}  k {:.4f} {:.4f} {:.4f}  {}", preset.name, eta.x, eta.y, eta.z,
                       k.x, k.y, k.z, preset.source);
  }
}

void listEffects() {
  for (const shaders::EffectInfo& e : shaders::kEffects)
    if (!e.name.empty()) console::printLine("{:<22} {}", e.name, e.description);
}

}  // namespace malus::bake
