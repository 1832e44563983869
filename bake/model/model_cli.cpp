#include "bake/model/model_cli.h"

#include <fmt/format.h>

namespace malus::bake {

void addModelOptions(CLI::App& command, ModelOptions& options) {
  command
      .add_option("--camera", options.camera,
                  fmt::format("Model files: camera of the file, by name or number from 0, or '{}' for a view of the "
                              "whole model (default: the first)",
                              kFramingCamera))
      ->type_name("NAME");
  command
      .add_option(
          "--environment", options.environment,
          "Model files: latitude-longitude image around the scene (default: none if the file has lights, else a "
          "studio)")
      ->type_name("FILE");
}

void requireModel(const std::filesystem::path& input, const ModelOptions& options, const std::string& kind) {
  if (isModelFile(input)) return;
  const char* const given = !options.camera.empty()        ? "--camera"
                            : !options.environment.empty() ? "--environment"
                                                           : nullptr;
  if (given != nullptr)
    throw CLI::ValidationError(
        given, fmt::format("is for model files (glTF, OBJ, PLY, STL, OFF); {} is {}", input.string(), kind));
}

}  // namespace malus::bake
