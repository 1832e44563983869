// The command line of preparation:
//   malus prep INPUT -o OUTPUT.mesh.drc [--report FILE.json] [--json] [--flat] [--sheet] [--crease DEG]
//              [--weld METRES] [--simplify-error METRES] [--position-bits N] [--normal-bits N]
#pragma once

#include <CLI/CLI.hpp>

namespace malus::prep {

// Adds the subcommand `prep`. Its callback throws malus::Error; a usage error is CLI11's.
void addPrepCommand(CLI::App& app);

}  // namespace malus::prep
