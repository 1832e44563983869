// Options of commands for model files (bake/model/model_scene.h): --camera and --environment.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "bake/model/model_scene.h"

namespace malus::bake {

void addModelOptions(CLI::App& command, ModelOptions& options);

// Throws CLI::ValidationError if an option is given although the input is not a model file. kind: what it is.
void requireModel(const std::filesystem::path& input, const ModelOptions& options, const std::string& kind);

}  // namespace malus::bake
