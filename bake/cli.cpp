#include "bake/cli.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/diff.h"
#include "bake/info.h"
#include "bake/materials/library.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "bake/scene_file/scene_file.h"
#include "bake/unpack.h"
#include "meshprep/base/console.h"

namespace malus::bake {

namespace {

struct BakeArguments {
  std::string input, output;
  pack::WriteSettings settings;
  bool json = false, force = false;
};

void runBake(const BakeArguments& arguments) {
  const SceneDescription description = readSceneFile(arguments.input);
  if (!arguments.force && isUpToDate(arguments.output, provenanceOf(description, arguments.settings))) {
    if (arguments.json)
      fmt::print("{}\n",
                 nlohmann::json{{"name", description.name}, {"output", arguments.output}, {"upToDate", true}}.dump(
                     2, ' ', false, nlohmann::json::error_handler_t::replace));
    else
      fmt::print("{}: {} is up to date: sources and settings are those that it was made of\n", description.name,
                 arguments.output);
    return;
  }
  const Baked baked = bake(description, arguments.settings, console::progress);
  console::progress("compressing");
  const pack::Written written = pack::write(arguments.output, baked.scene, arguments.settings);
  console::progressDone();
  for (const std::string& note : baked.notes) console::warn(note);

  std::size_t geometryBytes = 0;
  double positionError = 0, normalError = 0;
  for (const pack::MeshCompression& m : written.meshes) {
    geometryBytes += m.sizeBytes;
    positionError = std::max(positionError, static_cast<double>(m.positionErrorMax));
    normalError = std::max(normalError, static_cast<double>(m.normalErrorMaxDegrees));
  }
  const std::uint64_t vertices = baked.scene.vertexCount(), triangles = baked.scene.triangleCount();
  if (arguments.json) {
    nlohmann::json meshes = nlohmann::json::array();
    for (std::size_t i = 0; i < written.meshes.size(); ++i)
      meshes.push_back({{"name", baked.scene.meshes[i].name},
                        {"encoding", written.meshes[i].method},
                        {"sizeBytes", written.meshes[i].sizeBytes}});
    nlohmann::json preparation = nlohmann::json::array();
    for (const prep::Report& report : baked.reports) preparation.push_back(prep::toJson(report));
    const nlohmann::json result = {{"name", baked.scene.name},
                                   {"output", arguments.output},
                                   {"upToDate", false},
                                   {"sizeBytes", written.bytes.size()},
                                   {"vertices", vertices},
                                   {"triangles", triangles},
                                   {"meshes", meshes},
                                   {"preparation", preparation},
                                   {"notes", baked.notes},
                                   {"errors", {{"positionMax", positionError}, {"normalMaxDegrees", normalError}}}};
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  fmt::print(
      "{}: {} meshes, {} vertices, {} triangles -> {} ({} bytes, geometry {:.1f} bytes a triangle,\n"
      "  positions within {:.3g} m, normals within {:.3g} degrees)\n",
      baked.scene.name, baked.scene.meshes.size(), vertices, triangles, arguments.output, written.bytes.size(),
      static_cast<double>(geometryBytes) / static_cast<double>(std::max<std::uint64_t>(triangles, 1)), positionError,
      normalError);
}

}  // namespace

void addBakeCommand(CLI::App& app) {
  auto arguments = std::make_shared<BakeArguments>();
  CLI::App* command = app.add_subcommand("bake", "Bakes a scene description into a scene pack");
  command->add_option("scene", arguments->input, "scene.json (schema: bake/SCENE.md)")->required();
  command->add_option("-o,--output", arguments->output, "the pack to write")->required();
  command->add_option("--position-bits", arguments->settings.positionBits, "bits of the scene's position grid")
      ->check(CLI::Range(8, 22))
      ->capture_default_str();
  command->add_option("--normal-bits", arguments->settings.normalBits, "bits of the normals")
      ->check(CLI::Range(6, 16))
      ->capture_default_str();
  command->add_flag("--force", arguments->force, "bake although the pack is up to date");
  command->add_flag("--json", arguments->json, "print the result as JSON");
  command->callback([arguments] { runBake(*arguments); });
}

void addInfoCommand(CLI::App& app) {
  struct Arguments {
    std::string input, other;
    double tolerance = kInfoTolerance;
    bool verify = false, json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("info", "Tells what a scene pack holds");
  command->add_option("pack", arguments->input, "scene pack")->required();
  command
      ->add_option("--tolerance", arguments->tolerance, "share of the light that the deepest bounce named may change")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--verify", arguments->verify, "say that every hash, count and number was checked");
  command->add_option("--diff", arguments->other,
                      "another pack: tells which sections differ and how, and exits with 3 where any does");
  command->add_flag("--json", arguments->json, "print as JSON");
  command->callback([arguments] {
    const pack::Pack pack = pack::read(arguments->input);  // every check of the reader is made here
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
      // Texts of a pack may be no UTF-8.
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
  CLI::App* command = app.add_subcommand("unpack", "Takes a scene pack apart into JSON, PLY and EXR files");
  command->add_option("pack", arguments->input, "scene pack")->required();
  command->add_option("-o,--output", arguments->output, "folder to write (contents: bake/unpack.h)")->required();
  command->add_flag("--json", arguments->json, "print scene.json as well");
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

}  // namespace malus::bake
