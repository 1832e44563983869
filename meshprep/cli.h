// Command `malus prep INPUT -o OUTPUT.mesh.drc [OPTIONS]`: prepares a mesh (prepare.h) and compresses it.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::prep {

// Adds the subcommand. Its callback throws malus::Error; invalid arguments are CLI::ParseError.
void addPrepCommand(CLI::App& app);

}  // namespace malus::prep
