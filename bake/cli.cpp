#include "bake/cli.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/bake_report.h"
#include "bake/diff.h"
#include "bake/info.h"
#include "bake/materials/library.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "bake/previous_pack.h"
#include "bake/scene_file/scene_file.h"
#include "bake/unpack.h"
#include "meshprep/base/console.h"
#include "meshprep/base/unfinished_files.h"
#include "meshprep/deprecated_option.h"
#include "shaders/effects.h"

namespace malus::bake {

namespace {

struct BakeArguments {
  std::string input, output;
  pack::WriteSettings settings;
  BakeOptions options;
  bool json = false, force = false;
};

void runBake(const BakeArguments& arguments) {
  // Remove the unfinished files of killed bakers, and stop if the pack is up to date.
  removeAbandoned(arguments.output);
  const SceneDescription description = readSceneFile(arguments.input);
  for (const std::string& deprecation : description.deprecations) console::note(deprecation);
  const std::string provenance = makeProvenance(description, arguments.settings, arguments.options);
  std::optional<PreviousBake> previous;
  if (!arguments.force) previous = readPrevious(arguments.output);
  if (previous && isUpToDate(*previous, provenance)) {
    if (arguments.json)
      fmt::print("{}\n",
                 nlohmann::json{{"name", description.name}, {"output", arguments.output}, {"upToDate", true}}.dump(
                     2, ' ', false, nlohmann::json::error_handler_t::replace));
    else
      fmt::print("{}: {} is up to date: sources and settings are unchanged\n", description.name, arguments.output);
    return;
  }

  // Bake the scene and write the pack.
  const Baked baked = bake(description, arguments.settings, console::progress, arguments.options);
  console::progress("compressing");
  pack::WriteSettings settings = arguments.settings;
  settings.conversionError = baked.moved;
  const bool rebaked = previous && isOfSameVersions(*previous, provenance);
  const pack::PreviousPack source{rebaked ? &previous->pack : nullptr,
                                  rebaked ? previous->bytes : std::span<const std::byte>()};
  const pack::Written written = pack::write(arguments.output, baked.scene, settings, rebaked ? &source : nullptr);
  console::progressDone();
  for (const std::string& note : baked.notes) console::warn(note);

  // Report.
  for (const std::string& warning : written.warnings) console::warn(warning);
  if (arguments.json)
    fmt::print(
        "{}\n",
        bakeJson(baked, written, arguments.output).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    fmt::print("{}", bakeText(baked, written, arguments.output, rebaked));
}

}  // namespace

void addBakeCommand(CLI::App& app) {
  auto arguments = std::make_shared<BakeArguments>();
  CLI::App* command = app.add_subcommand("bake", "Bake a scene description into a scene pack");
  command->add_option("scene", arguments->input, "Scene description (bake/SCENE.md)")->required()->type_name("FILE");
  command->add_option("-o,--output", arguments->output, "Pack to write")->required()->type_name("PACK");
  command
      ->add_option("--position-error", arguments->settings.bounds.positionError,
                   "Largest distance of a vertex from its source [m]")
      ->check(CLI::PositiveNumber)
      ->type_name("METRES");
  command
      ->add_option("--normal-error", arguments->settings.bounds.normalErrorDegrees,
                   "Largest angle of a normal from its source [degrees]; without it 0.05 is a goal")
      ->check(CLI::PositiveNumber)
      ->type_name("DEGREES");
  command->add_option("--position-bits", arguments->settings.bounds.positionBits, "Exact number of bits per coordinate")
      ->check(CLI::Range(1, compress::kMaxPositionBits))
      ->type_name("N");
  command
      ->add_option("--normal-bits", arguments->settings.bounds.normalBits,
                   "Exact number of bits per coordinate of a normal")
      ->check(CLI::Range(compress::kMinNormalBits, compress::kMaxNormalBits))
      ->type_name("N");
  command->add_flag("--keep-map", arguments->settings.keepMap,
                    "Write the map from packed vertices and triangles to those of the source files");
  command->add_flag("--allow-open-glass", arguments->options.allowOpenGlass,
                    "Bake glass that is not a certified body, with a warning");
  command->add_flag("--force", arguments->force, "Bake although the pack is up to date, and encode every mesh again");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  addFormerOption(*command, "--max-normal-error", "--normal-error");
  addRemovedOption(*command, "--max-error", "--position-error");  // `render`: relative RMS error
  command->callback([arguments] { runBake(*arguments); });
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
      ->check(CLI::Range(0.0, 1.0))
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
      fmt::print("{}{}",
                 arguments->json ? difference.dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                                 : diffText(difference),
                 arguments->json ? "\n" : "");
      if (!difference.at("equal")) throw PacksDiffer{};
      return;
    }
    if (arguments->json) {
      // Texts of a pack may be invalid UTF-8.
      fmt::print("{}\n",
                 infoJson(pack, arguments->tolerance).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
      std::fputs(infoText(pack, arguments->tolerance).c_str(), stdout);
      if (arguments->verify)
        fmt::print("verified: {} sections, every hash, count, index and number\n", pack.sections.size());
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
      ->type_name("FOLDER");
  command->add_flag("--json", arguments->json, "Print scene.json as well");
  command->callback([arguments] {
    const pack::Pack pack = pack::read(arguments->input);
    const nlohmann::json document = unpack(pack, arguments->output);
    if (arguments->json) {
      fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
      fmt::print("{}: {} meshes -> {}\n", pack.scene.name, pack.scene.meshes.size(), arguments->output);
    }
  });
}

void listMaterials() {
  for (const OpticalConstants& m : materialLibrary())
    fmt::print("{:<14} eta {:.4f} {:.4f} {:.4f}  k {:.4f} {:.4f} {:.4f}  {}\n", m.name, m.eta.x, m.eta.y, m.eta.z,
               m.k.x, m.k.y, m.k.z, m.source);
}

void listEffects() {
  for (const shaders::EffectInfo& e : shaders::kEffects)
    if (!e.name.empty()) fmt::print("{:<22} {}\n", e.name, e.description);
}

}  // namespace malus::bake
