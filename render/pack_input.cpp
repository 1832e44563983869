#include "render/pack_input.h"

#include "bake/bake.h"
#include "bake/model/model_cli.h"
#include "render/make_renderer.h"

namespace malus::render {

void addPackInput(CLI::App& command, PackInput& input) {
  command.add_option("pack", input.file, "Scene pack, or a model: glTF, OBJ, PLY, STL, OFF")
      ->required()
      ->type_name("PACK");
  addModelOptions(command, input.model);
}

void addModelOptions(CLI::App& command, bake::ModelPackOptions& options) {
  bake::addModelOptions(command, options.model);
  command.add_flag("--allow-open-glass", options.allowOpenGlass,
                   "Bake glass that is not a certified body, with a warning");
}

void addInputs(OutputFiles& files, const PackInput& input) {
  files.addInput(input.file);
  bake::requireModel(input.file, input.model.model, "a scene pack");
  if (!bake::isModelFile(input.file)) {
    if (input.model.allowOpenGlass)
      throw CLI::ValidationError("--allow-open-glass", "is for model files: a pack has been checked");
    return;
  }
  for (const bake::SourceFile& source : bake::sourceFiles(bake::describeModel(input.file, input.model.model)))
    files.addInput(source.file);
}

std::string packFile(const PackInput& input) {
  return bake::isModelFile(input.file) ? bake::cachedPack(input.file, input.model, probeDepth).string() : input.file;
}

}  // namespace malus::render
