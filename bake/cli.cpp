#include "bake/cli.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/bake_report.h"
#include "bake/diff.h"
#include "bake/info.h"
#include "bake/materials/presets.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "bake/previous_pack.h"
#include "bake/scene_file/scene_file.h"
#include "bake/scene_json.h"
#include "bake/unpack.h"
#include "meshprep/base/console.h"
#include "meshprep/base/output_files.h"
#include "meshprep/base/unfinished_files.h"
#include "meshprep/deprecated_option.h"
#include "meshprep/json_text.h"
#include "meshprep/number_option.h"
#include "meshprep/output_option.h"
#include "meshprep/read/source_scene.h"
#include "shaders/effects.h"

namespace malus::bake {

namespace {

struct BakeArguments {
  std::string input, output;
  pack::WriteSettings settings;
  BakeOptions options;
  bool json = false, force = false;
};

// Refuses to write the pack over a file of the scene, or over a material library of a mesh, which is not read.
void checkFiles(const BakeArguments& arguments, const std::vector<SourceFile>& sources) {
  OutputFiles files;
  files.addInput(arguments.input);
  for (const SourceFile& source : sources) {
    files.addInput(source.file);
    std::error_code ignored;
    if (!source.mayBeMissing && std::filesystem::is_regular_file(source.file, ignored))
      for (const std::filesystem::path& file : prep::referencedFiles(source.file)) files.addInput(file);
  }
  files.addOutput(arguments.output, "--output");
  files.check();
}

void reportUpToDate(const BakeArguments& arguments, const pack::Scene& scene) {
  const std::vector<std::string> warnings = bakeWarnings(scene);
  for (const std::string& warning : warnings) console::warn(warning);
  if (arguments.json)
    console::printText(
        jsonText({{"name", scene.name}, {"output", arguments.output}, {"upToDate", true}, {"warnings", warnings}}) +
        "\n");
  else
    console::printLine("{}: {} is up to date: sources and settings are unchanged", scene.name, arguments.output);
}

void runBake(const BakeArguments& arguments, const MeasureDepth& measure) {
  // Remove the unfinished files of killed bakers, and stop if the pack is up to date.
  checkFiles(arguments, {});
  const SceneDescription description = readSceneFile(arguments.input);
  checkFiles(arguments, sourceFiles(description));
  removeAbandoned(arguments.output);
  for (const std::string& deprecation : description.deprecations) console::note(deprecation);
  const std::string provenance = makeProvenance(description, arguments.settings, arguments.options);
  std::optional<PreviousBake> previous;
  if (!arguments.force) previous = readPrevious(arguments.output);
  if (previous && isUpToDate(*previous, provenance)) {
    reportUpToDate(arguments, previous->pack.scene);
    return;
  }

  // Bake the scene and write the pack.
  Baked baked = bake(description, arguments.settings, console::progress, arguments.options);
  if (measure) {
    console::progress("measuring the light beyond the depth");
    baked.probe = measure(baked.scene);
    for (std::string& note : applyProbe(*baked.probe, baked.scene)) baked.notes.push_back(std::move(note));
  }
  console::progress("compressing");
  pack::WriteSettings settings = arguments.settings;
  settings.provenance = [&](std::vector<std::string> warnings) {
    warnings.insert(warnings.begin(), baked.notes.begin(), baked.notes.end());
    return withWarnings(baked.scene.provenance, std::move(warnings));
  };
  settings.inspection = glassInspection(baked.scene, baked.glassBodies);
  const bool rebaked = previous && isOfSameVersions(*previous, provenance);
  const pack::PreviousPack source{rebaked ? &previous->pack : nullptr,
                                  rebaked ? previous->bytes : std::span<const std::byte>()};
  const pack::Written written = pack::write(arguments.output, baked.scene, settings, rebaked ? &source : nullptr);
  console::progressDone();
  for (const std::string& note : baked.notes) console::warn(note);

  // Report.
  for (const std::string& warning : written.warnings) console::warn(warning);
  if (arguments.json)
    console::printText(jsonText(bakeJson(baked, written, arguments.output)) + "\n");
  else
    console::printText(bakeText(baked, written, arguments.output, rebaked));
}

}  // namespace

void addBakeCommand(CLI::App& app, MeasureDepth measure) {
  auto arguments = std::make_shared<BakeArguments>();
  CLI::App* command = app.add_subcommand("bake", "Bake a scene description into a scene pack");
  command->add_option("scene", arguments->input, "Scene description (bake/SCENE.md)")->required()->type_name("FILE");
  command->add_option("-o,--output", arguments->output, "Pack to write")
      ->required()
      ->check(outputName())
      ->type_name("PACK");
  command
      ->add_option("--position-error", arguments->settings.bounds.positionError,
                   "Largest distance of a vertex from its source [m]")
      ->transform(positiveNumber())
      ->type_name("METRES");
  command
      ->add_option("--normal-error", arguments->settings.bounds.normalErrorDegrees,
                   "Largest angle of a normal from its source [degrees]; without it 0.05 is a goal")
      ->transform(positiveNumber())
      ->type_name("DEGREES");
  command->add_option("--position-bits", arguments->settings.bounds.positionBits, "Exact number of bits per coordinate")
      ->transform(wholeNumberBetween(1, compress::kMaxPositionBits))
      ->type_name("N");
  command
      ->add_option("--normal-bits", arguments->settings.bounds.normalBits,
                   "Exact number of bits per coordinate of a normal")
      ->transform(wholeNumberBetween(compress::kMinNormalBits, compress::kMaxNormalBits))
      ->type_name("N");
  command->add_flag("--keep-map", arguments->settings.keepMap,
                    "Write the map from packed vertices and triangles to those of the source files");
  command->add_flag("--allow-open-glass", arguments->options.allowOpenGlass,
                    "Bake glass that is not a certified body, with a warning");
  command->add_flag("--strict", arguments->options.strict,
                    "Fail if a part of a file is invalid or has no area, instead of leaving it out with a warning");
  command->add_flag("--force", arguments->force, "Bake although the pack is up to date, and encode every mesh again");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  addFormerOption(*command, "--max-normal-error", "--normal-error");
  addRemovedOption(*command, "--max-error", "--position-error");  // `render`: relative RMS error
  command->callback([arguments, measure = std::move(measure)] { runBake(*arguments, measure); });
}

void addInfoCommand(CLI::App& app) {
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
  command->callback([arguments] {
    const pack::Pack pack = pack::read(arguments->input);  // makes every check of the reader
    if (!arguments->other.empty()) {
      const nlohmann::json difference = diffJson(pack, pack::read(arguments->other));
      console::printText(arguments->json ? jsonText(difference) + "\n" : diffText(difference));
      if (!difference.at("equal")) throw PacksDiffer{};
      return;
    }
    if (arguments->json) {
      console::printText(jsonText(infoJson(pack, arguments->tolerance)) + "\n");
    } else {
      console::printText(infoText(pack, arguments->tolerance));
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
