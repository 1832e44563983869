// The input of a command: a scene pack, or a model file, which is baked into the cache (bake/model/pack_cache.h).
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bake/model/pack_cache.h"
#include "meshprep/base/output_files.h"

namespace malus::render {

struct PackInput {
  std::string file;
  bake::ModelPackOptions model;
};

// The argument, and the options for model files.
void addPackInput(CLI::App& command, PackInput& input);
// The options alone: --camera, --environment and --allow-open-glass.
void addModelOptions(CLI::App& command, bake::ModelPackOptions& options);

// Registers the file and, of a model, the files that it reads. Throws CLI::ValidationError for options of model files
// with a pack, and Error for a model that cannot be read.
void addInputs(OutputFiles& files, const PackInput& input);

// Returns the pack: the file, or that of the model. Throws as cachedPack().
std::string packFile(const PackInput& input);

}  // namespace malus::render
