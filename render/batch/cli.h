// `malus batch`.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Renders the frames of a file of jobs into a folder, and continues a batch that was interrupted.
void addBatchCommand(CLI::App& app);

}  // namespace malus::render
