// malus view PACK|MODEL [--method M] [--compare-with M] [--polarizer DEG] ...          a window
// malus view PACK|MODEL --frames N [--script FILE] [--json]                           no window: frame times
//
// VIEW.md describes the window, the keys, the script and the JSON.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Adds the subcommand `view`. Its callback throws malus::Error: no display, no module of the viewer; a usage error is
// CLI11's.
void addViewCommand(CLI::App& app);

}  // namespace malus::render
