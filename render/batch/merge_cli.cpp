#include "render/batch/merge_cli.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "meshprep/base/console.h"
#include "meshprep/base/output_files.h"
#include "meshprep/json_text.h"
#include "meshprep/output_option.h"
#include "render/batch/manifest.h"
#include "render/batch/merge.h"
#include "render/output_folder.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

struct MergeArguments {
  std::vector<std::string> folders;
  std::string output;
  bool json = false;
};

void runMerge(const MergeArguments& a) {
  OutputFiles files;
  for (const std::string& folder : a.folders) {
    files.addInput(folder);
    files.addInput(fs::path(folder) / kManifestFile);
  }
  files.addOutputFolder(a.output, "--output");
  files.addOutput(fs::path(a.output) / kManifestFile, "--output");
  files.check();
  const OutputFolder made(a.output);
  const std::size_t frames = mergeBatches({a.folders.begin(), a.folders.end()}, a.output);
  if (a.json)
    console::printText(jsonText({{"frames", frames}, {"folders", a.folders}, {"output", a.output}}) + "\n");
  else
    console::printLine("{}: {} frames of {} folders", a.output, frames, a.folders.size());
}

}  // namespace

void addMergeCommand(CLI::App& app) {
  auto a = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand("merge", "Check and join the folders of the shards of a batch");
  command->add_option("folders", a->folders, "Folders of 'malus batch' with --shard or --tiles")
      ->required()
      ->type_name("FOLDER");
  command->add_option("-o,--output", a->output, "Folder for all files and one manifest.jsonl")
      ->required()
      ->check(outputName())
      ->type_name("FOLDER");
  command->add_flag("--json", a->json, "Print the result as JSON");
  command->callback([a] { runMerge(*a); });
}

}  // namespace malus::render
